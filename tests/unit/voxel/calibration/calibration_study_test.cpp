#include "voxel/calibration/calibration_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "io/study/study_reader.h"
#include "tests/support/described_study.h"

namespace menger::voxel {
namespace {

/// A study whose keys fit together also where each is drawn by chance.
struct PossibleStudy : CalibrationStudy {};

void describe(io::StudyVisitor& visitor, PossibleStudy& study) {
  describe(visitor, static_cast<CalibrationStudy&>(study));
  if (dynamic_cast<tests::RandomStudy*>(&visitor) == nullptr) return;
  for (auto& [quantity, range] : study.bounds)
    range = {std::min(range.lowest, range.highest), std::max(range.lowest, range.highest)};
  if (study.pressures_Pa) study.pressures_Pa = {-std::abs(study.pressures_Pa->lowest), std::abs(study.pressures_Pa->highest)};
  if (study.plan.choice) study.plan.details.push_back(*study.plan.choice);
  if (study.frequency_response) study.frequency_response->body = {.name = "", .cells = {2, 1, 1}, .digits = "12"};
}

PossibleStudy parsed(const std::string& text) {
  PossibleStudy study;
  io::read_described(io::parse_toml(text, "study.toml"), study);
  return study;
}

TEST(CalibrationStudy, TemplateIsReadToTheDefaultsAndToEachAlternative) { tests::expect_template_is_read<PossibleStudy>(parsed); }

TEST(CalibrationStudy, TextsOfAllStudiesAreReadBack) {
  tests::expect_texts_are_read_back<PossibleStudy>(parsed, 30, {}, {"cells", "digits"});
}

TEST(CalibrationStudy, ReadsWhatItIsGivenAndKeepsTheRest) {
  const PossibleStudy study = parsed(
      "curves = [\"a\", \"/b\"]\n[holds_for]\nsilicone = \"s\"\ncell_edge_m = 0.01\n"
      "wall_thickness_m = 0.002\n[fit]\nchoice = \"fading\"\nloss = \"cauchy\"\npressures_Pa = [-1, 2]\n"
      "[weights]\nsag = 3\n[bounds]\naxial_Pa = [1, 2]\n");
  EXPECT_EQ(study.places, (std::vector<std::filesystem::path>{"a", "/b"}));
  EXPECT_EQ(study.plan.choice, CalibrationDetail::fading);
  EXPECT_EQ(study.plan.fit.loss_scale, 3.0);
  EXPECT_EQ(study.pressures_Pa->highest, 2.0);
  EXPECT_EQ(study.weights.at(meshes::LoadCaseKind::sag), 3.0);
  EXPECT_EQ(study.weights.at(meshes::LoadCaseKind::stretch), 1.0);
  EXPECT_EQ(study.bounds.at(Quantity::axial).highest, 2.0);
  EXPECT_EQ(study.bounds.size(), 1U);
}

}  // namespace
}  // namespace menger::voxel
