#include "voxel/statics/beam_tangent.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/unit/voxel/statics/static_samples.h"
#include "voxel/model/surrogate_beams.h"

namespace menger::voxel {
namespace {

BeamCoefficients<double> coefficients() { return beam_coefficients(section_of(sample_parameters(), 4), sample_edge); }

/// Poses of the ends of a deformed beam along an axis.
std::array<Pose, 2> deformed(int axis, double across) {
  std::array<double, 3> separation{across, across, across};
  separation[static_cast<std::size_t>(axis)] = 1.1 * sample_edge;
  const Pose lower{{0.3, -0.2, 0.1}, quaternion_of(Vector3<double>{0.02, -0.03, 0.01})};
  return {lower,
          {lower.position + Vector3<double>{separation[0], separation[1], separation[2]},
           quaternion_of(Vector3<double>{-0.01, 0.04, 0.05})}};
}

Pose moved(const Pose& pose, Eigen::Index component, double step) {
  std::array<double, 6> change{};
  change[static_cast<std::size_t>(component)] = step;
  return {pose.position + Vector3<double>{change[0], change[1], change[2]},
          quaternion_of(Vector3<double>{change[3], change[4], change[5]}) * pose.orientation};
}

void expect_stiffness_matches_differences(int axis, bool small) {
  const std::array<Pose, 2> poses = deformed(axis, small ? 1e-4 : 2e-3);
  const BeamCoefficients<double> c = coefficients();
  const BeamTangent tangent = beam_tangent(beam_ends(poses[0], poses[1], axis, sample_edge), small, c, axis, sample_edge);
  const auto loads = [&](Eigen::Index column, double step) {
    std::array<Pose, 2> changed = poses;
    Pose& pose = changed[static_cast<std::size_t>(column / 6)];
    pose = moved(pose, column % 6, step);
    return beam_end_loads(beam_ends(changed[0], changed[1], axis, sample_edge), small, c, axis);
  };
  for (Eigen::Index column = 0; column < 12; ++column) {
    const bool turns = column % 6 >= 3;
    const double step = turns ? 1e-5 : 1e-5 * sample_edge;
    const EndLoads slope = (loads(column, -step) - loads(column, step)) / (2.0 * step);
    for (Eigen::Index row = 0; row < 12; ++row) {
      // 1e-8 of the largest entry of its kind: steps of 1e-5 leave 1e-10 of curvature, 1e-11 of rounding.
      const double scale = c.shear * (turns ? sample_edge : 1.0) * (row % 6 >= 3 ? sample_edge : 1.0);
      EXPECT_NEAR(tangent.stiffness(row, column), slope(row), 1e-8 * scale) << axis << " " << row << " " << column;
    }
  }
}

TEST(BeamTangent, MatchesDifferencesInTheSmallAngleState) {
  for (const int axis : {0, 1, 2}) expect_stiffness_matches_differences(axis, true);
}

TEST(BeamTangent, MatchesDifferencesInTheLargeAngleState) {
  for (const int axis : {0, 1, 2}) expect_stiffness_matches_differences(axis, false);
}

TEST(BeamTangent, IsSymmetricWithoutLoad) {
  const std::array<Pose, 2> poses{Pose{}, Pose{{0.0, sample_edge, 0.0}, {1.0, 0.0, 0.0, 0.0}}};
  for (const bool small : {false, true}) {
    const auto k = beam_tangent(beam_ends(poses[0], poses[1], 1, sample_edge), small, coefficients(), 1, sample_edge).stiffness;
    EXPECT_LT((k - k.transpose()).norm(), 1e-8 * k.norm());
  }
}

}  // namespace
}  // namespace menger::voxel
