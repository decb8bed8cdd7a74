#include "meshes/hexahedra/element_geometry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace menger::meshes {
namespace {

CornerPoints cuboid(double x, double y, double z) {
  CornerPoints corners{};
  for (std::size_t c = 0; c < 8; ++c)
    corners[c] = {(c & 1U) != 0 ? x : 0.0, (c >> 1U & 1U) != 0 ? y : 0.0, (c >> 2U & 1U) != 0 ? z : 0.0};
  return corners;
}

TEST(ElementGeometry, CuboidHasItsVolumeAndTheBestShape) {
  const CornerPoints corners = cuboid(1.0, 2.0, 4.0);
  EXPECT_DOUBLE_EQ(element_volume(corners), 8.0);
  EXPECT_DOUBLE_EQ(scaled_jacobian(corners), 1.0);
  EXPECT_EQ(edge_range(corners), (std::pair{1.0, 4.0}));
  EXPECT_DOUBLE_EQ(smallest_determinant(corners), 8.0);
}

TEST(ElementGeometry, VolumeOfAFrustumIsExact) {
  // A square pyramid cut off: V = h (a^2 + a b + b^2) / 3, which one point in the middle would not give.
  CornerPoints corners = cuboid(2.0, 2.0, 3.0);
  for (std::size_t c = 4; c < 8; ++c) corners[c] = {0.5 + 0.5 * corners[c][0], 0.5 + 0.5 * corners[c][1], 3.0};
  EXPECT_NEAR(element_volume(corners), 3.0 * (4.0 + 2.0 + 1.0) / 3.0, 1e-14);
}

TEST(ElementGeometry, ScaledJacobianOfAShearedElementIsTheSineOfItsAngle) {
  CornerPoints corners = cuboid(1.0, 1.0, 1.0);
  for (std::size_t c = 4; c < 8; ++c) corners[c][0] += 1.0;  // edges at 45 degrees
  EXPECT_NEAR(scaled_jacobian(corners), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(element_volume(corners), 1.0, 1e-15);
}

TEST(ElementGeometry, APointThatIsNoNumberHasNoDeterminant) {
  for (std::size_t c = 0; c < 8; ++c) {
    CornerPoints corners = cuboid(1.0, 1.0, 1.0);
    corners[c][1] = std::nan("");
    EXPECT_TRUE(std::isnan(smallest_determinant(corners))) << c;
  }
}

TEST(ElementGeometry, SeesInvertedElements) {
  CornerPoints mirrored = cuboid(1.0, 1.0, 1.0);
  for (Point& corner : mirrored) corner[0] = -corner[0];
  EXPECT_LT(smallest_determinant(mirrored), 0.0);
  EXPECT_DOUBLE_EQ(scaled_jacobian(mirrored), -1.0);
  CornerPoints dented = cuboid(1.0, 1.0, 1.0);
  dented[7] = {0.2, 0.2, 0.2};
  EXPECT_GT(element_volume(dented), 0.0);
  EXPECT_LT(smallest_determinant(dented), 0.0);
  CornerPoints flat = cuboid(1.0, 1.0, 0.0);
  EXPECT_EQ(scaled_jacobian(flat), -1.0);
}

TEST(ElementGeometry, FacesOfAnElementLookOutwards) {
  const CornerPoints corners = cuboid(1.0, 2.0, 3.0);
  double volume = 0.0;
  for (const Side side : all_sides) {
    const auto& around = face_corners[static_cast<std::size_t>(side)];
    const Point normal =
        cross(difference(corners[around[1]], corners[around[0]]), difference(corners[around[3]], corners[around[0]]));
    EXPECT_GT(is_max(side) ? normal[axis_of(side)] : -normal[axis_of(side)], 0.0) << to_string(side);
    volume += flux_of_position({corners[around[0]], corners[around[1]], corners[around[2]], corners[around[3]]}) / 3.0;
  }
  EXPECT_NEAR(volume, 6.0, 1e-14);
}

TEST(ElementGeometry, FluxThroughTwistedFacesGivesTheVolume) {
  CornerPoints corners = cuboid(1.0, 1.0, 1.0);
  corners[7] = {1.3, 1.1, 0.8};
  corners[1] = {0.9, -0.2, 0.1};
  double flux = 0.0;
  for (const auto& around : face_corners)
    flux += flux_of_position({corners[around[0]], corners[around[1]], corners[around[2]], corners[around[3]]});
  EXPECT_NEAR(flux / 3.0, element_volume(corners), 1e-14);
}

}  // namespace
}  // namespace menger::meshes
