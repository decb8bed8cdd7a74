#include "evolution/search/discrepancy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "evolution/genome/robot_form.h"

namespace menger::evolution {
namespace {

constexpr Distinction any_material{.materials = false, .place = false};

std::vector<std::string> poses(const std::string& digits) {
  return robot_poses(meshes::Polycube::from_digits(3, 3, 3, digits), any_material);
}

const std::string flat = "111111000000000000000000000";
const std::string bar = "111000000000000000000000000";
const std::string turned_bar = "100100100000000000000000000";
const std::string tower = "100000000100000000100000000";

TEST(Discrepancy, WithoutEvaluatedRobotsNothingIsCorrected) {
  const Discrepancy none;
  EXPECT_EQ(none.kind(), Correction::none);
  EXPECT_EQ(none.corrected(poses(bar), 0.3), 0.3);
  EXPECT_FALSE(none.error());
}

TEST(Discrepancy, TheMedianRatioBearsAnOutlier) {
  // Ratios of 0.5, 0.5 and 40: the mean would be 13.7.
  const Discrepancy learnt({{poses(bar), 0.2, 0.1}, {poses(flat), 0.4, 0.2}, {poses(tower), 0.01, 0.4}});
  EXPECT_EQ(learnt.kind(), Correction::median_ratio);
  EXPECT_DOUBLE_EQ(learnt.ratio(), 0.5);
  EXPECT_DOUBLE_EQ(learnt.corrected(poses(flat), 0.3), 0.15);
  // Left out in turn, the others' median is 20.25, 20.25 and 0.5: |4.05 - 0.1|, |8.1 - 0.2|, |0.005 - 0.4|.
  EXPECT_NEAR(learnt.error().value(), (3.95 + 7.9 + 0.395) / 3.0, 1e-12);
  EXPECT_EQ(learnt.error(), learnt.error_of_ratio());
}

TEST(Discrepancy, OneRobotGivesARatioWithoutAnError) {
  const Discrepancy learnt({{poses(bar), 0.2, 0.05}});
  EXPECT_DOUBLE_EQ(learnt.ratio(), 0.25);
  EXPECT_FALSE(learnt.error());
}

TEST(Discrepancy, RobotsThatTheSurrogateHoldsStillGiveNoRatio) {
  const Discrepancy still({{poses(bar), 0.0, 0.05}, {poses(flat), 0.0, 0.0}});
  EXPECT_EQ(still.ratio(), 1.0);
  const Discrepancy mixed({{poses(bar), 0.0, 0.05}, {poses(flat), 0.1, 0.2}});
  EXPECT_DOUBLE_EQ(mixed.ratio(), 2.0);
}

/// Robots of two kinds: plates with one more cell move twice as far as on the surrogate, towers do not move at all.
std::vector<ScorePair> two_kinds() {
  std::vector<ScorePair> evaluated;
  for (std::size_t cell = 6; cell < 9; ++cell) {
    std::string plate = flat;
    plate[cell] = '1';
    evaluated.push_back({poses(plate), 0.1 + 0.01 * static_cast<double>(cell), 0.2 + 0.02 * static_cast<double>(cell)});
    std::string post = tower;
    post[cell - 5] = '1';
    evaluated.push_back({poses(post), 0.1 + 0.01 * static_cast<double>(cell), 0.0});
  }
  return evaluated;
}

TEST(Discrepancy, LearnsWhichShapesTheSurrogateMisestimates) {
  const Discrepancy learnt(two_kinds());
  EXPECT_EQ(learnt.kind(), Correction::gaussian_process);
  EXPECT_LT(learnt.error().value(), 0.9 * learnt.error_of_ratio().value());
  std::string plate = flat;
  plate[6] = plate[7] = '1';
  std::string post = tower;
  post[1] = post[10] = '1';
  EXPECT_GT(learnt.corrected(poses(plate), 0.15), 2.0 * learnt.corrected(poses(post), 0.15));
  EXPECT_GE(learnt.corrected(poses(post), 1e-6), 0.0) << "no score is negative";
}

TEST(Discrepancy, ShapesThatTellNothingLeaveTheRatio) {
  // The ratio is the same for all, so a Gaussian process cannot improve it.
  std::vector<ScorePair> evaluated = two_kinds();
  for (ScorePair& one : evaluated) one.reference = 0.5 * one.surrogate;
  const Discrepancy learnt(evaluated);
  EXPECT_EQ(learnt.kind(), Correction::median_ratio);
  EXPECT_DOUBLE_EQ(learnt.ratio(), 0.5);
  EXPECT_NEAR(learnt.error().value(), 0.0, 1e-15);
}

TEST(Discrepancy, DoesNotSeeHowARobotStands) {
  const Discrepancy learnt(two_kinds());
  ASSERT_EQ(learnt.kind(), Correction::gaussian_process);
  // The poses are the same in another order: results are equal up to rounding.
  EXPECT_NEAR(learnt.corrected(poses(bar), 0.1), learnt.corrected(poses(turned_bar), 0.1), 1e-14);
}

TEST(Discrepancy, ARobotFarFromAllEvaluatedHasTheRatioNearlyToItself) {
  const Discrepancy learnt(two_kinds());
  const std::string far = "000000000222222222222222222";
  const double pull = std::abs(learnt.corrected(poses(far), 0.1) - learnt.ratio() * 0.1);
  const double near = std::abs(learnt.corrected(two_kinds()[0].poses, 0.1) - learnt.ratio() * 0.1);
  EXPECT_LT(pull, 0.5 * near);
}

}  // namespace
}  // namespace menger::evolution
