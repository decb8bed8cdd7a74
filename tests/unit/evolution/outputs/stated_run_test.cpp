#include "evolution/outputs/stated_run.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace menger::evolution {
namespace {

using nlohmann::json;

/// The parameters of a walk on finite elements, as menger locomote writes them.
json elements() {
  return json::parse(R"({
    "design": {"name": "hook", "cell_edge_m": 0.012, "layers": [["11"], ["10"]], "level": 1, "wall_thickness_m": 0.0025,
               "chambers": "single"},
    "material": {"law": {"name": "ogden_2", "convention": "ogden", "moduli_Pa": [40000.0, 100], "exponents": [2, 6]},
                 "modulus_factor": 1},
    "drive": {"mode": "in_phase", "pressure_Pa": [0, 3000], "frequency_Hz": 3},
    "ground": {"static_friction": 1.0, "kinetic_friction": 0.8}})");
}

/// Those of the same walk in the surrogate, as menger simulate writes them: with keys that have no meaning in its mode.
json surrogate() {
  return json::parse(R"({
    "design": {"name": "hook", "cell_edge_m": 0.012, "layers": [["11"], ["10"]], "level": 1},
    "surrogate": {"chambers": "single", "values": {"holds_for": {"silicone": "Ecoflex 00-30", "cell_edge_m": 0.012,
        "wall_thickness_m": 0.0025, "chambers": "single",
        "law": "name = \"ogden_2\", convention = \"ogden\", moduli_Pa = [4e4, 100], exponents = [2, 6]"}}},
    "drive": {"mode": "in_phase", "pressure_Pa": [0.0, 3e3], "frequency_Hz": 3.0, "ramp_s": 0.333333333333, "material_phase": [0, 0.5],
              "wave_axis": "x", "wave_periods_per_body": 1, "wave_over_gaps": true},
    "ground": {"present": true, "static_friction": 1, "kinetic_friction": 0.8}})");
}

bool are_one(const json& a, const json& b) { return are_one_walk(stated_run(a), stated_run(b)); }

TEST(StatedRun, IsOneWalkInBothModels) { EXPECT_TRUE(are_one(elements(), surrogate())); }

TEST(StatedRun, HasTheHighestPressureOfTheDriveAndTheKindOfElements) {
  EXPECT_EQ(stated_run(surrogate()).highest_pressure_Pa, 3000.0);
  json parameters = elements();
  parameters["elements"]["kind"] = "thin_wall";
  parameters["drive"]["pressure_Pa"] = "much";
  EXPECT_EQ(stated_run(parameters).elements, "thin_wall");
  EXPECT_FALSE(stated_run(parameters).highest_pressure_Pa);
}

TEST(StatedRun, ComparesPhasesOnlyWhereTheyHaveAMeaning) {
  json a = elements();
  json b = surrogate();
  a["drive"]["mode"] = b["drive"]["mode"] = "antiphase";
  a["drive"]["material_phase"] = json::array({0.0, 0.5});
  EXPECT_TRUE(are_one(a, b));
  a["drive"]["material_phase"] = json::array({0.0, 0.25});
  EXPECT_FALSE(are_one(a, b));
}

TEST(StatedRun, ComparesWavesOnlyWhereTheyHaveAMeaning) {
  json a = elements();
  json b = surrogate();
  a["drive"]["mode"] = b["drive"]["mode"] = "wave";
  for (const char* key : {"wave_axis", "wave_periods_per_body", "wave_over_gaps"}) a["drive"][key] = b["drive"][key];
  EXPECT_TRUE(are_one(a, b));
  for (const char* key : {"wave_axis", "wave_periods_per_body", "wave_over_gaps"}) {
    json other = a;
    other["drive"].erase(key);
    EXPECT_FALSE(are_one(other, b)) << key;
  }
}

TEST(StatedRun, HasARampOfOnePeriodIfNoneIsStated) {
  json b = surrogate();
  b["drive"]["ramp_s"] = 1.0;
  EXPECT_FALSE(are_one(elements(), b));
  json a = elements();
  a["drive"]["ramp_s"] = 1;
  EXPECT_TRUE(are_one(a, b));
}

TEST(StatedRun, IsAnotherWalkWithAnotherDrive) {
  for (const char* key : {"mode", "pressure_Pa", "frequency_Hz"}) {
    json a = elements();
    a["drive"][key] = key == std::string("mode") ? json("hold") : json(2.0);
    EXPECT_FALSE(are_one(a, surrogate())) << key;
  }
}

TEST(StatedRun, IsAnotherBodyWithOtherWallsChambersOrSilicone) {
  json a = elements();
  a["design"]["wall_thickness_m"] = 0.002;
  EXPECT_FALSE(are_one(a, surrogate()));
  a = elements();
  a["design"]["chambers"] = "per-phase";
  EXPECT_FALSE(are_one(a, surrogate()));
  a = elements();
  a["material"]["law"]["moduli_Pa"] = json::array({5e4, 100});
  EXPECT_FALSE(are_one(a, surrogate()));
  EXPECT_FALSE(are_of_one_body(stated_run(a), stated_run(elements())));
  a = elements();
  a["material"]["modulus_factor"] = 1.2;
  EXPECT_FALSE(are_one(a, surrogate()));
  json b = surrogate();
  b["surrogate"]["silicone"] = "Dragon Skin 10";
  EXPECT_FALSE(are_of_one_body(stated_run(b), stated_run(surrogate())));
}

TEST(StatedRun, AgreesWithWhatIsNotStated) {
  json a = elements();
  a["design"].erase("wall_thickness_m");
  a["design"].erase("chambers");
  a.erase("material");
  a.erase("ground");
  EXPECT_TRUE(are_one(a, surrogate()));
  json b = surrogate();
  b["surrogate"]["values"]["holds_for"]["law"] = "neo-Hookean";  // words, not the law
  EXPECT_TRUE(are_one(elements(), b));
}

TEST(StatedRun, IsAnotherWalkOnOtherGround) {
  for (const char* key : {"static_friction", "kinetic_friction"}) {
    json a = elements();
    a["ground"][key] = 0.3;
    EXPECT_FALSE(are_one(a, surrogate())) << key;
    EXPECT_TRUE(are_of_one_body(stated_run(a), stated_run(surrogate()))) << key;
  }
}

TEST(StatedRun, IsNoWalkOfABodyThatIsNotStated) {
  EXPECT_FALSE(are_one(json::object(), json::object()));
  json a = elements();
  a["design"]["cell_edge_m"] = 0.0;
  EXPECT_FALSE(stated_run(a).body);
  EXPECT_FALSE(stated_run(json::parse("[1]")).body);
}

TEST(StatedRun, HasStrokesOnlyWhereThePressureSwings) {
  const auto run_of = [](const char* mode) {
    return stated_run(nlohmann::json{{"drive", {{"mode", mode}, {"pressure_Pa", {0, 6000}}, {"frequency_Hz", 3.0}}}});
  };
  EXPECT_EQ(run_of("in_phase").stroke_frequency_Hz(), 3.0);
  for (const char* mode : {"hold", "none"}) {
    EXPECT_FALSE(run_of(mode).stroke_frequency_Hz()) << mode;
    EXPECT_EQ(run_of(mode).frequency_Hz, 3.0) << "falls are looked for at its periods";
  }
}

}  // namespace
}  // namespace menger::evolution
