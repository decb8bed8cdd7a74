#include "voxel/validation/volume_actuation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/voxel/validation/validation_samples.h"

namespace menger::voxel {
namespace {

using meshes::LoadCaseKind;
using samples::bar_curve;

// Sums and quotients of a few numbers of order one.
constexpr double actuation_rounding = 1e-12;

/// Chamber of three cells of 1 cm with walls of 2 mm.
constexpr double chamber_share = 0.026 * 0.006 * 0.006 / (0.03 * 0.01 * 0.01);

/// An inflation curve with these changes of outer volume.
meshes::ResponseCurve curve_of(const std::vector<double>& pressures_Pa, std::vector<double> outer_changes) {
  for (double& change : outer_changes) change /= chamber_share;
  const std::vector<double> zeros(pressures_Pa.size(), 0.0);
  return bar_curve("bar_inflation", LoadCaseKind::inflation, {pressures_Pa, outer_changes, zeros, zeros, zeros, zeros});
}

TEST(VolumeActuation, AimsAtTheVolumesOfSolidVoxels) {
  const ActuationAim aim = actuation_aim(6e3, 0.144714);
  EXPECT_NEAR(aim.largest_change, 0.5, 1e-5) << "the amplitude is given to six digits";
  EXPECT_NEAR(aim.smallest_change, -0.3743, 1e-4);
}

TEST(VolumeActuation, ReadsTheCurveBetweenItsStates) {
  meshes::ResponseCurve curve = curve_of({-4e3, -2e3, 5e3, 10e3, 20e3}, {-0.4, -0.2, 0.1, 0.3, 0.9});
  const VolumeActuation actuation =
      volume_actuation(curve, "bar", {.pressure_Pa = 6e3, .largest_change = 0.5, .smallest_change = -0.3});
  EXPECT_NEAR(actuation.chamber_share, chamber_share, actuation_rounding);
  EXPECT_NEAR(actuation.change_at_pressure.value(), 0.14, actuation_rounding);
  EXPECT_NEAR(actuation.pressure_for_largest_Pa.value(), 10e3 + 10e3 / 3.0, 1e-8);
  EXPECT_NEAR(actuation.pressure_for_smallest_Pa.value(), -3e3, 1e-8);
  EXPECT_NEAR(actuation.change_at_lowest, -0.4, actuation_rounding);
}

TEST(VolumeActuation, KnowsTheStateAtRestWithoutARowForIt) {
  const VolumeActuation actuation = volume_actuation(curve_of({12e3}, {0.6}), "bar", actuation_aim(6e3, 0.144714));
  EXPECT_NEAR(actuation.change_at_pressure.value(), 0.3, actuation_rounding);
  EXPECT_FALSE(actuation.pressure_for_smallest_Pa.has_value());
  EXPECT_EQ(actuation_sentences(actuation, actuation_aim(6e3, 0.144714)).back(), "the curve contains no vacuum");
}

TEST(VolumeActuation, ReadsOffNothingBeyondTheCurve) {
  meshes::ResponseCurve curve = curve_of({-4e3, 0.0, 5e3}, {-0.1, 0.0, 0.2});
  curve.provenance.limit_pressure_Pa = 6.25e3;
  curve.provenance.contact_pressure_Pa = -4e3;
  const ActuationAim aim = actuation_aim(6e3, 0.144714);
  const VolumeActuation actuation = volume_actuation(curve, "bar", aim);
  EXPECT_FALSE(actuation.change_at_pressure.has_value());
  EXPECT_FALSE(actuation.pressure_for_largest_Pa.has_value());
  EXPECT_FALSE(actuation.pressure_for_smallest_Pa.has_value());
  const std::vector<std::string> sentences = actuation_sentences(actuation, aim);
  EXPECT_NE(sentences[0].find("limit pressure is 6.25 kPa"), std::string::npos) << sentences[0];
  EXPECT_NE(sentences[1].find("+20 % at the end of the curve, at 5 kPa (0.8 of the limit pressure)"), std::string::npos)
      << sentences[1];
  EXPECT_NE(sentences[2].find("walls touch at -4 kPa"), std::string::npos) << sentences[2];
}

}  // namespace
}  // namespace menger::voxel
