#include "materials/laws/silicone_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "materials/laws/homogeneous_deformations.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::materials {
namespace {

namespace fs = std::filesystem;

fs::path ready(const std::string& name) { return fs::path(MENGER_SOURCE_DIR) / "materials/data" / (name + ".toml"); }

/// The message with which a record is refused after one replacement in that of Dragon Skin 10, without the folder.
std::string refusal(const std::string& from, const std::string& to) {
  std::string text = io::read_whole(ready("dragon_skin_10"));
  const std::size_t place = text.find(from);
  if (place == std::string::npos) return "nothing to replace";
  const tests::TestFolder folder;
  const fs::path file = folder / "record.toml";
  io::write_whole(file, text.replace(place, from.size(), to));
  try {
    (void)read_silicone(file);
  } catch (const io::InputError& error) {
    const std::string message = error.what();
    const std::string start = folder.path().string() + "/";
    return message.rfind(start, 0) == 0 ? message.substr(start.size()) : message;
  }
  return "accepted";
}

struct Stated {
  std::string name;
  std::string shore;
  double density_kg_per_m3;
  double modulus_100_percent_psi;
};

/// What the bulletins print, apart from the files.
const std::map<std::string, Stated>& bulletins() {
  static const std::map<std::string, Stated> stated{
      {"dragon_skin_10", {"Dragon Skin 10", "10A", 1070, 22}}, {"dragon_skin_20", {"Dragon Skin 20", "20A", 1080, 49}},
      {"dragon_skin_30", {"Dragon Skin 30", "30A", 1080, 86}}, {"ecoflex_00_10", {"Ecoflex 00-10", "00-10", 1040, 8}},
      {"ecoflex_00_30", {"Ecoflex 00-30", "00-30", 1070, 10}}, {"ecoflex_00_50", {"Ecoflex 00-50", "00-50", 1070, 12}}};
  return stated;
}

TEST(SiliconeRecord, ReadyOnesStateWhatTheBulletinsDo) {
  for (const auto& [file, stated] : bulletins()) {
    const SiliconeRecord record = read_silicone(ready(file));
    EXPECT_EQ(record.name, stated.name);
    EXPECT_EQ(record.data_sheet.shore_hardness, stated.shore);
    EXPECT_EQ(record.data_sheet.density_kg_per_m3, stated.density_kg_per_m3);
    EXPECT_NEAR(record.data_sheet.modulus_100_percent_Pa.value(), stated.modulus_100_percent_psi * 6894.757, 1.0);
    EXPECT_TRUE(record.data_sheet.tensile_strength_Pa) << file;
    EXPECT_TRUE(record.data_sheet.elongation_at_break) << file;
    EXPECT_FALSE(record.not_measured.empty()) << file;
  }
  int files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(MENGER_SOURCE_DIR) / "materials/data")) {
    ++files;
    EXPECT_EQ(bulletins().count(entry.path().stem().string()), 1U) << entry.path();
  }
  EXPECT_EQ(files, 6);
}

TEST(SiliconeRecord, RecommendedLawReproducesTheModulusOfTheDataSheet) {
  for (const auto& [file, stated] : bulletins()) {
    const SiliconeRecord record = read_silicone(ready(file));
    EXPECT_EQ(name_of(record.recommended.law), "neo_hookean");
    EXPECT_EQ(record.recommended.largest_stretch, 2.0);
    const NominalStress stress = nominal_stress(record.recommended.law, LoadingMode::uniaxial, 2.0);
    EXPECT_NEAR(stress.stress_Pa, record.data_sheet.modulus_100_percent_Pa.value(), 1.5) << file;
  }
}

TEST(SiliconeRecord, DatabaseFitsAreSofterThanTheRecommendedLaw) {
  for (const auto& [file, stated] : bulletins()) {
    const SiliconeRecord record = read_silicone(ready(file));
    int fits = 0;
    for (const SourcedLaw& other : record.others) {
      if (other.source.find("Soft Robotics Materials Database") == std::string::npos) continue;
      ++fits;
      EXPECT_NE(other.source.find("lower bound"), std::string::npos) << file;
      EXPECT_LT(shear_modulus_at_rest_Pa(other.law), shear_modulus_at_rest_Pa(record.recommended.law)) << file;
    }
    EXPECT_GE(fits, 1) << file;
  }
}

TEST(SiliconeRecord, SoftestAndStiffestLawBoundAllOthers) {
  const std::vector<SourcedLaw> laws = read_silicone(ready("ecoflex_00_30")).others;
  ASSERT_GT(laws.size(), 2U);
  const auto [softest, stiffest] = softest_and_stiffest(laws);
  double least_Pa = shear_modulus_at_rest_Pa(laws.front().law);
  double most_Pa = least_Pa;
  for (const SourcedLaw& one : laws) {
    least_Pa = std::min(least_Pa, shear_modulus_at_rest_Pa(one.law));
    most_Pa = std::max(most_Pa, shear_modulus_at_rest_Pa(one.law));
  }
  EXPECT_EQ(shear_modulus_at_rest_Pa(softest.law), least_Pa);
  EXPECT_EQ(shear_modulus_at_rest_Pa(stiffest.law), most_Pa);
  EXPECT_LT(least_Pa, most_Pa);
  const auto [only, same] = softest_and_stiffest(std::span(laws).first(1));
  EXPECT_EQ(only.source, laws.front().source);
  EXPECT_EQ(same.source, laws.front().source);
}

TEST(SiliconeRecord, OgdenFitHasTheShearModulusOfItsSource) {
  const SiliconeRecord record = read_silicone(ready("dragon_skin_10"));
  bool found = false;
  for (const SourcedLaw& other : record.others) {
    if (name_of(other.law) != "ogden1" || other.largest_stretch > 2.0) continue;
    found = true;
    EXPECT_NEAR(shear_modulus_at_rest_Pa(other.law), 40222.06281, 1e-3);
  }
  EXPECT_TRUE(found);
}

TEST(SiliconeRecord, SaysWhatWasNotMeasured) {
  for (const auto& [file, stated] : bulletins()) {
    const SiliconeRecord record = read_silicone(ready(file));
    const auto is_missing = [&](const char* quantity) {
      return std::ranges::find(record.not_measured, quantity) != record.not_measured.end();
    };
    EXPECT_TRUE(is_missing("friction")) << file;
    ASSERT_TRUE(record.friction) << file << ": what is published of silicones";
    EXPECT_LT(record.friction->lowest, record.friction->highest) << file;
    EXPECT_NE(record.friction->source.find("doi"), std::string::npos) << file;
    EXPECT_EQ(is_missing("damping"), file != "ecoflex_00_30") << file;
    EXPECT_EQ(record.loss.has_value(), file == "ecoflex_00_30") << file;
  }
}

TEST(SiliconeRecord, RefusesWrongValuesWithFileAndKey) {
  const std::string density = refusal("density_kg_per_m3 = 1070", "density_kg_per_m3 = 0");
  EXPECT_NE(density.find("data_sheet.density_kg_per_m3 = 0: must be > 0"), std::string::npos) << density;
  EXPECT_EQ(density.rfind("record.toml:", 0), 0U) << density;
  const std::string law = refusal("\"neo_hookean\"", "\"neohookean\"");
  EXPECT_NE(law.find("recommended.law.name = \"neohookean\""), std::string::npos) << law;
  const std::string modulus = refusal("shear_modulus_Pa = 86677", "shear_modulus_Pa = -1");
  EXPECT_NE(modulus.find("recommended.law.shear_modulus_Pa = -1: must be > 0"), std::string::npos) << modulus;
  const std::string unit = refusal("density_kg_per_m3", "density_g_per_cm3");
  EXPECT_NE(unit.find("density_kg_per_m3 is missing"), std::string::npos) << unit;
  const std::string range = refusal("largest_stretch = 2", "largest_stretch = 1");
  EXPECT_NE(range.find("recommended.largest_stretch = 1: must be > 1"), std::string::npos) << range;
  const std::string source = refusal(
      "source = \"Smooth-On, technical bulletin of the Dragon Skin series, as quoted in a public repository\"", "source = \"\"");
  EXPECT_NE(source.find("data_sheet.source = \"\": must not be empty"), std::string::npos) << source;
  EXPECT_NE(refusal("[data_sheet]\n", "[data_sheet]\ncolour = \"white\"\n").find("colour: unknown key"), std::string::npos);
}

const std::string own_mix =
    "name = \"Mix 3\"\n[data_sheet]\nsource = \"weighed\"\ndensity_kg_per_m3 = 1100\n[recommended]\nsource = \"a test\"\n"
    "smallest_stretch = 1\nlargest_stretch = 2\n[recommended.law]\nname = \"neo_hookean\"\nshear_modulus_Pa = 2e5\n";

TEST(SiliconeRecord, OfOnesOwnMixNeedsOnlyWhatIsComputedWith) {
  const tests::TestFolder folder;
  io::write_whole(folder / "record.toml", own_mix);
  const SiliconeRecord record = read_silicone(folder / "record.toml");
  EXPECT_EQ(record.data_sheet.density_kg_per_m3, 1100.0);
  EXPECT_EQ(record.data_sheet.shore_hardness, "");
  EXPECT_FALSE(record.data_sheet.modulus_100_percent_Pa);
  EXPECT_FALSE(record.data_sheet.tensile_strength_Pa);
  EXPECT_FALSE(record.data_sheet.elongation_at_break);
  EXPECT_TRUE(record.not_measured.empty());
  const std::string hardness = refusal("shore_hardness = \"10A\"", "shore_hardness = \"\"");
  EXPECT_NE(hardness.find("data_sheet.shore_hardness = \"\": must not be empty"), std::string::npos) << hardness;
}

TEST(SiliconeRecord, NamesAllKeysThatAreMissing) {
  const tests::TestFolder folder;
  const std::string file = (folder / "record.toml").string();
  const auto refused = [&](const std::string& text) {
    io::write_whole(file, text);
    return tests::message_of([&] { (void)read_silicone(file); });
  };
  const std::string end = ", which are missing: see \"Your own silicone\" in materials/README.md";
  EXPECT_EQ(refused("name = \"Mix 3\"\n[recommended]\nsource = \"a test\"\n"),
            file +
                ": a record of a silicone must have data_sheet.source, data_sheet.density_kg_per_m3, "
                "recommended.smallest_stretch, recommended.largest_stretch, recommended.law" +
                end);
  const std::string wrong_kind = refused("name = \"Mix 3\"\ndata_sheet = 5\n");
  EXPECT_NE(wrong_kind.find("must have recommended.source, "), std::string::npos) << wrong_kind;
  std::string without_name = own_mix;
  without_name.erase(0, without_name.find('\n') + 1);
  EXPECT_NE(refused(without_name).find("record.toml:1: name is missing"), std::string::npos) << "one alone, with its line";
}

TEST(SiliconeRecord, RefusesAWrongRangeOfFriction) {
  const std::string order = refusal("lowest = 0.25", "lowest = 1.25");
  EXPECT_NE(order.find("friction.highest = 1: must not be less than lowest"), std::string::npos) << order;
  const std::string sign = refusal("lowest = 0.25", "lowest = -0.25");
  EXPECT_NE(sign.find("friction.lowest = -0.25: must be >= 0"), std::string::npos) << sign;
}

TEST(SiliconeRecord, ReadsLossDataWhereThereAreAny) {
  EXPECT_FALSE(read_silicone(ready("dragon_skin_10")).loss);
  std::string text = io::read_whole(ready("dragon_skin_10"));
  const std::string table = "\n[loss]\nsource = \"a test\"\ntan_delta = 0.12\nfrequency_Hz = 2\n";
  const tests::TestFolder folder;
  const fs::path file = folder / "record.toml";
  io::write_whole(file, text + table);
  EXPECT_THROW((void)read_silicone(file), io::InputError) << "damping is named as not measured";
  text.replace(text.find("\"damping\", "), 11, "");
  io::write_whole(file, text + table);
  const SiliconeRecord record = read_silicone(file);
  ASSERT_TRUE(record.loss);
  EXPECT_EQ(record.loss->tan_delta, 0.12);
  EXPECT_EQ(record.loss->frequency_Hz, 2.0);
  EXPECT_EQ(record.loss->points(), (std::vector<LossPoint>{{0.12, 2.0}}));
}

TEST(SiliconeRecord, ReadsLossFactorsAtSeveralFrequencies) {
  const auto loss = read_silicone(ready("ecoflex_00_30")).loss;
  ASSERT_TRUE(loss);
  EXPECT_EQ(loss->frequency_Hz, 30.0) << "the highest one";
  ASSERT_EQ(loss->points().size(), 4U);
  // G = mu (1 + (i w 330 us)^0.32)
  for (const auto& [tan_delta, frequency_Hz] : loss->points()) {
    const std::complex<double> added = std::pow(std::complex<double>(0.0, 2.0 * std::numbers::pi * frequency_Hz * 330e-6), 0.32);
    EXPECT_NEAR(tan_delta, added.imag() / (1.0 + added.real()), 5e-5) << frequency_Hz;
  }
  const auto refused = [](const std::string& keys) {
    const tests::TestFolder folder;
    std::string text = io::read_whole(ready("dragon_skin_10"));
    text.replace(text.find("\"damping\", "), 11, "");
    io::write_whole(folder / "record.toml", text + "\n[loss]\nsource = \"a test\"\n" + keys);
    try {
      (void)read_silicone(folder / "record.toml");
    } catch (const io::InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refused("tan_delta = [0.1, 0.2]\nfrequency_Hz = [1]\n").find("frequency_Hz = [1]: must have as many"),
            std::string::npos);
  EXPECT_NE(refused("tan_delta = [0.1, 0.2]\nfrequency_Hz = [2, 1]\n").find("must ascend"), std::string::npos);
  EXPECT_NE(refused("tan_delta = []\nfrequency_Hz = []\n").find("tan_delta"), std::string::npos);
}

TEST(SiliconeRecord, NamesAMissingFile) { EXPECT_THROW((void)read_silicone(ready("absent")), io::InputError); }

}  // namespace
}  // namespace menger::materials
