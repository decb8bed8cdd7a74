#include "meshes/load_cases/body_extents.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace menger::meshes {
namespace {

// positions are of the order of 0.03 m: the rounding of a few operations on them, and of a rotation known to 1e-14
constexpr double rounding_m = 1e-15;
// where the alternation of rotation and stretch has ended within 1e-14 of its step, some steps from its end
constexpr double fitted_m = 1e-13;

/// End faces of an L of 1 cm cells: (0,0), (1,0), (2,0) and (0,1), (0,2).
EndPoints ends_of_an_l() {
  return {{{{{0.000, 0.015, 0.005}, {0.030, 0.005, 0.005}}},
           {{{0.015, 0.000, 0.005}, {0.005, 0.030, 0.005}}},
           {{{0.011, 0.011, 0.000}, {0.011, 0.011, 0.010}}}}};
}

template <class Map>
EndPoints mapped(EndPoints ends, const Map& map) {
  for (auto& axis : ends) {
    for (auto& end : axis) {
      const Eigen::Vector3d image = map(Eigen::Vector3d(end[0], end[1], end[2]));
      end = {image[0], image[1], image[2]};
    }
  }
  return ends;
}

Eigen::Quaterniond random_rotation(std::mt19937& engine) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine)).normalized();
}

TEST(BodyExtents, AtRestAreTheDistancesOfTheEnds) {
  const auto extents = extents_without_rotation(ends_of_an_l(), ends_of_an_l());
  EXPECT_NEAR(extents[0], 0.03, rounding_m);
  EXPECT_NEAR(extents[1], 0.03, rounding_m);
  EXPECT_NEAR(extents[2], 0.01, rounding_m);
}

TEST(BodyExtents, OfAStretchThatIsTurnedAreThoseOfTheStretch) {
  std::mt19937 engine(1);
  const Eigen::Vector3d stretches(1.3, 0.8, 1.1);
  for (int sample = 0; sample < 20; ++sample) {
    const Eigen::Quaterniond rotation = random_rotation(engine);
    const auto deformed = mapped(ends_of_an_l(), [&](const Eigen::Vector3d& X) -> Eigen::Vector3d {
      return rotation * stretches.cwiseProduct(X) + Eigen::Vector3d(0.2, -0.1, 0.4);
    });
    const auto extents = extents_without_rotation(ends_of_an_l(), deformed);
    EXPECT_NEAR(extents[0], 1.3 * 0.03, fitted_m);
    EXPECT_NEAR(extents[1], 0.8 * 0.03, fitted_m);
    EXPECT_NEAR(extents[2], 1.1 * 0.01, fitted_m);
  }
}

TEST(BodyExtents, DoNotChangeUnderRigidMotionsOfAnyDeformedBody) {
  std::mt19937 engine(2);
  std::normal_distribution<double> disturbance(0.0, 0.002);
  for (int sample = 0; sample < 20; ++sample) {
    const auto deformed = mapped(ends_of_an_l(), [&](const Eigen::Vector3d& X) -> Eigen::Vector3d {
      return X + Eigen::Vector3d(disturbance(engine), disturbance(engine), disturbance(engine));
    });
    const auto extents = extents_without_rotation(ends_of_an_l(), deformed);
    const Eigen::Quaterniond rotation = random_rotation(engine);
    const auto moved = mapped(
        deformed, [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return rotation * x + Eigen::Vector3d(-0.3, 0.7, 0.1); });
    const auto moved_extents = extents_without_rotation(ends_of_an_l(), moved);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(moved_extents[axis], extents[axis], fitted_m);
  }
}

TEST(BodyExtents, RotationOfABodyIsThatOfItsTurn) {
  std::mt19937 engine(3);
  for (int sample = 0; sample < 20; ++sample) {
    const Eigen::Matrix3d turn = random_rotation(engine).toRotationMatrix();
    const auto deformed = mapped(ends_of_an_l(), [&](const Eigen::Vector3d& X) -> Eigen::Vector3d {
      return turn * Eigen::Vector3d(0.7, 1.2, 1.1).cwiseProduct(X);
    });
    const auto found = rotation_of_body(ends_of_an_l(), deformed);
    // the points lie some 0.01 m apart, where fitted_m is an angle of 1e-11
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column)
        EXPECT_NEAR(found[row][column], turn(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)), 1e-11);
  }
}

TEST(BodyExtents, AreFiniteForEndsOnOneLine) {
  const EndPoints line = {
      {{{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}}, {{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}}, {{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}}}};
  for (const double extent : extents_without_rotation(line, line)) EXPECT_TRUE(std::isfinite(extent));
}

}  // namespace
}  // namespace menger::meshes
