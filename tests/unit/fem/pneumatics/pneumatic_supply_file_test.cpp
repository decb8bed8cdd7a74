#include "fem/pneumatics/pneumatic_supply_file.h"

#include <gtest/gtest.h>

#include "io/study/study_reader.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"

namespace menger::fem {
namespace {

const std::vector<std::string> plena{"plenum 0", "plenum 1", "plenum 2"};

StudySupply parse(const std::string& text) {
  StudySupply supply;
  io::read_described(io::parse_toml(text, "study.toml"), supply);
  return supply;
}

PneumaticSupply read(const std::string& text) { return supply_of(parse(text), plena, io::parse_toml(text, "study.toml")); }

std::string message(const std::string& text) {
  return tests::message_of([&] { read(text); });
}

const std::string cam =
    "[[piston]]\nname = 'cam'\nbore_m = 0.03\ncylinder_length_m = 0.05\nstroke_m = 0.04\nfrequency_Hz = 1.2\n";
const std::string on_cam = "[[pressure]]\nplenum = 'plenum 0'\nsupply = 'piston'\npiston = 'cam'\n";
const std::string resistance = "resistance_Pa_s_per_m3 = 1e7\n";

TEST(PneumaticSupplyFile, ReadsEveryKindOfSupply) {
  const PneumaticSupply supply =
      read(cam + "phase = 0.5\nramp_s = 0.2\nfill_pressure_Pa = 200\ndead_volume_m3 = 1e-6\n" + on_cam +
           "length_m = 2\ndiameter_m = 3e-3\n" +
           "[[pressure]]\nplenum = 'plenum 2'\nsupply = 'line'\nschedule = 'constant'\npressure_Pa = 2e4\nramp_s = 0.1\n" +
           resistance + "volume_m3 = 5e-6\n[gas]\nexponent = 1.4\nambient_pressure_Pa = 9e4\n");
  EXPECT_EQ(supply.gas().exponent, 1.4);
  EXPECT_EQ(supply.gas().ambient_pressure_Pa, 9e4);
  ASSERT_EQ(supply.pistons().size(), 1U);
  EXPECT_EQ(supply.pistons()[0].phase, 0.5);
  EXPECT_EQ(supply.pistons()[0].ramp_s, 0.2);
  EXPECT_EQ(supply.pistons()[0].fill_pressure_Pa, 200.0);
  EXPECT_EQ(supply.pistons()[0].dead_volume_m3, 1e-6);
  const auto& by_piston = std::get<PistonSupply>(supply.plena()[0]);
  EXPECT_EQ(by_piston.line.resistance_Pa_s_per_m3, round_line(2.0, {3e-3}).resistance_Pa_s_per_m3);
  ASSERT_TRUE(by_piston.line.bore);
  EXPECT_EQ(by_piston.line.bore->diameter_m, 3e-3);
  EXPECT_EQ(pressure_Pa(std::get<PlenumSchedule>(supply.plena()[1]), 1.0), 0.0);
  const auto& by_line = std::get<LineSupply>(supply.plena()[2]);
  EXPECT_EQ(pressure_Pa(by_line.source, 0.05), 1e4);
  EXPECT_EQ(by_line.line.resistance_Pa_s_per_m3, 1e7);
  EXPECT_EQ(by_line.line.volume_m3, 5e-6);
}

TEST(PneumaticSupplyFile, PlainSchedulesNeedNoSupply) {
  const PneumaticSupply supply = read("[[pressure]]\nplenum = 'plenum 1'\nschedule = 'constant'\npressure_Pa = 6e3\n");
  EXPECT_FALSE(supply.has_lines());
  EXPECT_EQ(supply.pressure_Pa(supply.start(0.0, std::vector<double>(3, 1e-5)), 1), 6e3);
}

TEST(PneumaticSupplyFile, BadInputNamesFileKeyAndValue) {
  const auto has = [](const std::string& text, const std::string& part) {
    const std::string found = message(text);
    EXPECT_NE(found.find(part), std::string::npos) << found;
    EXPECT_NE(found.find("study.toml"), std::string::npos) << found;
  };
  EXPECT_EQ(message(cam + on_cam + resistance), "no error");
  has(cam + on_cam + "resistance_Pa_s_per_m3 = -1\n", "resistance_Pa_s_per_m3 = -1");
  has(cam + on_cam + "resistance_Pa_s_per_m3 = 1e300\n", "resistance_Pa_s_per_m3 = 1e+300: must be at most 1e+21 Pa s/m3");
  has(cam + on_cam, "resistance_Pa_s_per_m3");
  has(cam + on_cam + "length_m = 1\n", "diameter_m");
  has(cam + on_cam + "length_m = 1\ndiameter_m = 1e-3\n" + resistance, "resistance_Pa_s_per_m3");
  has(cam + on_cam + resistance + on_cam + resistance, "already has a supply");
  has(cam + cam + on_cam + resistance, "another piston has this name");
  has(cam + "[[pressure]]\nplenum = 'lung'\nsupply = 'piston'\npiston = 'cam'\n" + resistance, "\"lung\"");
  has("[gas]\nexponent = 1\n", "pressure is missing");
  has(cam + on_cam + resistance + "schedule = 'sine'\n", "belongs to supply = \"schedule\" or \"line\"");
  has("[[pressure]]\nplenum = 'plenum 0'\nschedule = 'constant'\npressure_Pa = 0\nduty = 0.5\n",
      "belongs to schedule = \"square\"");
  has(cam + "[[pressure]]\nplenum = 'plenum 0'\nsupply = 'piston'\npiston = 'pump'\n" + resistance, "\"pump\"");
  has(on_cam + resistance, "the file has no [[piston]]");
  has(cam + "[[pressure]]\nplenum = 'plenum 0'\nschedule = 'constant'\npressure_Pa = 0\n", "supplies no plenum");
  has("[[pressure]]\nplenum = 'plenum 0'\nsupply = 'line'\nschedule = 'constant'\npressure_Pa = -2e5\n" + resistance, "vacuum");
  has("[[pressure]]\nplenum = 'plenum 0'\nsupply = 'hose'\n", "supply");
  has(cam + on_cam + resistance + "colour = 'red'\n", "colour");
  std::string long_stroke = cam;
  long_stroke.replace(long_stroke.find("stroke_m = 0.04"), 15, "stroke_m = 0.0625");
  has(long_stroke + on_cam + resistance, "stroke_m = 0.0625");
  long_stroke.replace(long_stroke.find("stroke_m = 0.0625"), 17, "stroke_m = 0.05");
  has(long_stroke + on_cam + resistance, "leaves no room for the air");
  EXPECT_EQ(message(long_stroke + on_cam + resistance + "volume_m3 = 1e-6\n"), "no error");
}

TEST(PneumaticSupplyFile, TemplateAndTextsAreRead) {
  tests::expect_template_is_read<StudySupply>(parse, {"piston", "pressure.supply = \"piston\""});  // one without the other
  tests::expect_texts_are_read_back<StudySupply>(parse, 10);
}

}  // namespace
}  // namespace menger::fem
