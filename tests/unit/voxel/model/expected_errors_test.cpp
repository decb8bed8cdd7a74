#include "voxel/model/expected_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "io/text/whole_file.h"
#include "tests/support/surrogate_example.h"
#include "tests/support/test_folder.h"
#include "voxel/model/surrogate_file.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;
using meshes::Polycube;

const Polycube bar = Polycube::from_digits(3, 1, 1, "111");
const Polycube plate = Polycube::from_digits(2, 2, 1, "1111");
const Polycube table = Polycube::from_digits(3, 3, 2, "000101000111111111");

/// Good on limbs, bad on flat plates, unknown on all others.
ExpectedErrors example_errors() {
  ExpectedErrors errors{.parameters_hash = hash_of(tests::surrogate_example())};
  errors.kinds[static_cast<std::size_t>(BodyKind::limbs)] = {.bodies = {"l", "u"},
                                                             .displacements = 20,
                                                             .volumes = 5,
                                                             .displacement_median = 0.043,
                                                             .displacement_ninth_decile = 0.12,
                                                             .volume_median = 0.011,
                                                             .signs = 15};
  errors.kinds[static_cast<std::size_t>(BodyKind::flat_plate)] = {
      .bodies = {"plane"}, .displacements = 9, .displacement_median = 0.4, .signs = 8, .wrong_signs = 3};
  return errors;
}

CalibratedBody body_of_known_errors() {
  return {.parameters = tests::surrogate_example(), .pressure_Pa = {0.0, 1e3}, .outside_range = OutsideRange::warn};
}

/// Parameters in a folder, with a table of errors beside them.
class ErrorsBesideParameters : public testing::Test {
 protected:
  ErrorsBesideParameters() {
    io::write_whole(parameters_, surrogate_text(tests::surrogate_example()));
    expected_errors_table(example_errors()).write(expected_errors_file(parameters_));
  }
  [[nodiscard]] KnownErrors known() const { return known_errors(read_surrogate(parameters_), parameters_); }

  const tests::TestFolder folder_;
  const fs::path parameters_ = folder_ / "soft.toml";
};

bool has_warning(const std::vector<std::string>& lines, const std::string& text) {
  return std::ranges::any_of(
      lines, [&](const std::string& line) { return line.starts_with("warning: ") && line.find(text) != std::string::npos; });
}

TEST(ExpectedErrors, OfOtherKindsAreKeptWhileTheParametersAreTheSame) {
  ExpectedErrors found{.parameters_hash = "one"};
  found.kinds[static_cast<std::size_t>(BodyKind::aggregate_of_limbs)] = KindErrors{.bodies = {"pair"}};
  ExpectedErrors earlier{.parameters_hash = "one"};
  earlier.kinds[static_cast<std::size_t>(BodyKind::limbs)] = KindErrors{.bodies = {"elbow"}};
  earlier.kinds[static_cast<std::size_t>(BodyKind::aggregate_of_limbs)] = KindErrors{.bodies = {"old"}};
  const ExpectedErrors all = together_with(found, earlier);
  EXPECT_EQ(all.of(BodyKind::limbs), earlier.of(BodyKind::limbs));
  EXPECT_EQ(all.of(BodyKind::aggregate_of_limbs), found.of(BodyKind::aggregate_of_limbs));
  earlier.parameters_hash = "another";
  EXPECT_EQ(together_with(found, earlier), found);
  EXPECT_EQ(together_with(found, std::nullopt), found);
}

TEST_F(ErrorsBesideParameters, AreReadAsTheyWereWritten) {
  EXPECT_EQ(expected_errors_file(parameters_).filename(), "soft.errors.csv");
  EXPECT_EQ(read_expected_errors(parameters_), example_errors());
  EXPECT_FALSE(read_expected_errors(folder_ / "other.toml"));
}

TEST_F(ErrorsBesideParameters, AreThoseOfTheKindOfABody) {
  const std::vector<std::string> lines = expected_error_text(known(), body_of_known_errors(), bar);
  ASSERT_EQ(lines.size(), 1U) << io::joined(lines, "\n");
  EXPECT_EQ(lines.front().rfind("expected error for a body of limbs: 4.3 % in displacement and 1.1 % in chamber volume (median "
                                "over 2 bodies of this kind that no fit has seen; one in ten by more than 12 %)",
                                0),
            0U)
      << lines.front();
}

TEST_F(ErrorsBesideParameters, OfOneBodyNameIt) {
  ExpectedErrors errors = example_errors();
  errors.kinds[static_cast<std::size_t>(BodyKind::limbs)]->bodies = {"elbow"};
  const std::string line = expected_error_text({.errors = errors}, body_of_known_errors(), bar).front();
  EXPECT_NE(line.find("(of one body alone, \"elbow\", which tells little of others; "), std::string::npos) << line;
}

TEST_F(ErrorsBesideParameters, HaveNoPowersOfTenForPeople) {
  ExpectedErrors errors = example_errors();
  errors.kinds[static_cast<std::size_t>(BodyKind::limbs)]->displacement_median = 0.0995;
  errors.kinds[static_cast<std::size_t>(BodyKind::limbs)]->displacement_ninth_decile = 1.389;
  const std::string line = expected_error_text({.errors = errors}, body_of_known_errors(), bar).front();
  EXPECT_NE(line.find("10 % in displacement"), std::string::npos) << line;
  EXPECT_NE(line.find("more than 139 %"), std::string::npos) << line;
}

TEST_F(ErrorsBesideParameters, WarnOfLargeErrorsAndWrongSigns) {
  const std::vector<std::string> lines = expected_error_text(known(), body_of_known_errors(), plate);
  EXPECT_TRUE(has_warning(lines, "the voxels are a poor model of flat plates")) << io::joined(lines, "\n");
  EXPECT_TRUE(has_warning(lines, "3 of 8 displacements went the wrong way"));
  ExpectedErrors good = example_errors();
  KindErrors& of_plates = *good.kinds[static_cast<std::size_t>(BodyKind::flat_plate)];
  of_plates.displacement_median = largest_good_error;
  of_plates.wrong_signs = 0;
  EXPECT_EQ(expected_error_text({.errors = good}, body_of_known_errors(), plate).size(), 1U);
  of_plates.displacement_median.reset();
  EXPECT_TRUE(has_warning(expected_error_text({.errors = good}, body_of_known_errors(), plate), "poor model"))
      << "without a response";
}

TEST_F(ErrorsBesideParameters, WarnWhereNoValidationCoversABody) {
  EXPECT_TRUE(has_warning(expected_error_text(known(), body_of_known_errors(), table), "covers plates on legs"));
  CalibratedBody body = body_of_known_errors();
  body.level = 2;
  EXPECT_TRUE(has_warning(expected_error_text(known(), body, bar), "covers aggregates"));
  body = body_of_known_errors();
  body.pressure_Pa = {0.0, 3e3};
  const std::vector<std::string> driven = expected_error_text(known(), body, bar);
  EXPECT_TRUE(has_warning(driven, "pressure_Pa = 3000 is outside")) << io::joined(driven, "\n");
  EXPECT_TRUE(driven.front().starts_with("expected error for a body of limbs, if the fit covered it: ")) << driven.front();
  body = body_of_known_errors();
  body.chambers = meshes::ChamberLayout::per_phase;
  EXPECT_TRUE(has_warning(expected_error_text(known(), body, bar), "chambers"));
}

TEST_F(ErrorsBesideParameters, AreListedByKindForASearch) {
  const std::vector<std::string> lines = expected_error_text(known(), false);
  EXPECT_EQ(std::ranges::count_if(lines, [](const std::string& line) { return line.starts_with("  "); }), 2);
  EXPECT_TRUE(has_warning(lines, "covers blocks"));
  EXPECT_TRUE(has_warning(lines, "poor model of flat plates"));
  EXPECT_TRUE(has_warning(lines, "displacements went the wrong way on flat plates (3 of 8)"));
  EXPECT_FALSE(has_warning(lines, "covers aggregates"));
  EXPECT_TRUE(has_warning(expected_error_text(known(), true), "covers aggregates"));
}

TEST_F(ErrorsBesideParameters, CountForNothingIfTheyAreOfOtherValues) {
  SurrogateParameters other = tests::surrogate_example();
  other.neck_ratio = 1.25;
  io::write_whole(parameters_, surrogate_text(other));
  const KnownErrors stale = known();
  EXPECT_FALSE(stale.errors);
  for (const auto& lines : {expected_error_text(stale, body_of_known_errors(), bar), expected_error_text(stale, false)}) {
    EXPECT_EQ(lines.size(), 1U);
    EXPECT_TRUE(has_warning(lines, "beside soft.toml is that of other values"));
  }
  fs::remove(expected_errors_file(parameters_));
  EXPECT_TRUE(has_warning(expected_error_text(known(), false), "no table of errors lies beside soft.toml"));
  EXPECT_TRUE(has_warning(expected_error_text(known_errors(other, std::nullopt), false), "without a file"));
}

TEST_F(ErrorsBesideParameters, AreRefusedWithTheirPlaceIfTheyAreWrong) {
  const fs::path file = expected_errors_file(parameters_);
  const std::string text = io::read_whole(file);
  const auto refuses = [&](const std::string& from, const std::string& to, const std::string& message) {
    std::string wrong = text;
    ASSERT_NE(wrong.find(from), std::string::npos) << from;
    io::write_whole(file, wrong.replace(wrong.find(from), from.size(), to));
    try {
      static_cast<void>(known());
      FAIL() << "accepted " << to;
    } catch (const io::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("soft.errors.csv"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  };
  refuses("flat_plate", "tray", "kind = \"tray\"");
  refuses("0.043", "-0.043", "displacement_median");
  refuses("\nflat_plate", "\nlimbs", "kind = \"limbs\": is there twice");
  refuses(example_errors().parameters_hash, "0", "is not that of the first row");
}

TEST(ShippedErrors, AreThoseOfTheParametersThatTheyLieBeside) {
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(MENGER_SOURCE_DIR "/voxel/parameters")) {
    if (entry.path().extension() != ".csv") continue;
    const std::string name = entry.path().stem().stem().string();
    const fs::path parameters = entry.path().parent_path() / (name + ".toml");
    const KnownErrors known = known_errors(read_surrogate(parameters), parameters);
    EXPECT_TRUE(known.errors) << name << ": " << known.missing << "; run menger validate --keep";
    found.push_back(name);
  }
  for (const char* name : {"dragon_skin_10_1cm", "ecoflex_00_30_12mm"})
    EXPECT_TRUE(std::ranges::find(found, name) != found.end()) << name;
}

}  // namespace
}  // namespace menger::voxel
