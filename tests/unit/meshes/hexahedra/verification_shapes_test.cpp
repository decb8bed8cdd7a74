#include "meshes/hexahedra/verification_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/mesh_quality.h"
#include "tests/unit/meshes/hexahedra/mesh_checks.h"

namespace menger::meshes {
namespace {

constexpr double pi = std::numbers::pi;

/// All corners of the faces with a label.
template <class Check>
void for_each_point_of(const HexahedralMesh& mesh, const std::string& label, const Check& check) {
  std::size_t count = 0;
  for (const BoundaryFace& face : mesh.faces) {
    if (face.label != label_index(mesh, label)) continue;
    for (const std::size_t corner : face.corners) check(mesh.points[corner]);
    ++count;
  }
  EXPECT_GT(count, 0U) << label;
}

void expect_in_coordinate_plane(const HexahedralMesh& mesh, const std::string& label, std::size_t axis) {
  for_each_point_of(mesh, label, [&](const Point& point) { ASSERT_EQ(point[axis], 0.0) << label; });
}

TEST(VerificationShapes, BoxHasItsSidesAndVolume) {
  const HexahedralMesh mesh = box({1.0, 2.0, 3.0}, {2, 3, 4});
  EXPECT_EQ(mesh.elements.size(), 24U);
  EXPECT_EQ(mesh.points.size(), 60U);
  EXPECT_NEAR(solid_volume(mesh), 6.0, 1e-13);
  expect_sound(mesh);
  EXPECT_NEAR(label_area(mesh, "x min"), 6.0, 1e-13);
  EXPECT_NEAR(label_area(mesh, "y max"), 3.0, 1e-13);
  for_each_point_of(mesh, "z max", [](const Point& point) { EXPECT_EQ(point[2], 3.0); });
}

TEST(VerificationShapes, CooksMembraneIsTheTrapezium) {
  const HexahedralMesh mesh = cooks_membrane(1.0, 2.0, {4, 4, 1});
  EXPECT_NEAR(solid_volume(mesh), 2.0 * 48.0 * 0.5 * (44.0 + 16.0), 1e-10);
  expect_sound(mesh);
  EXPECT_NO_THROW(require_no_inverted_elements(mesh, "membrane"));
  EXPECT_NEAR(label_area(mesh, "x min"), 88.0, 1e-12);
  EXPECT_NEAR(label_area(mesh, "x max"), 32.0, 1e-12);
  for_each_point_of(mesh, "x max", [](const Point& point) {
    EXPECT_DOUBLE_EQ(point[0], 48.0);
    EXPECT_GE(point[1], 44.0);
    EXPECT_LE(point[1], 60.0);
  });
}

TEST(VerificationShapes, SphereOctantLiesOnItsSpheresAndPlanes) {
  const HexahedralMesh mesh = thick_sphere_octant(1.0, 2.0, 3, 4);
  EXPECT_EQ(mesh.elements.size(), 3U * 3U * 16U);
  EXPECT_EQ(mesh.geometry, Geometry::spherical);
  expect_sound(mesh);
  EXPECT_NO_THROW(require_no_inverted_elements(mesh, "sphere"));
  EXPECT_NO_THROW(require_closed_chambers(mesh, "sphere"));
  for_each_point_of(mesh, "chamber 0", [](const Point& point) { EXPECT_NEAR(length(point), 1.0, 1e-15); });
  for_each_point_of(mesh, "outer", [](const Point& point) { EXPECT_NEAR(length(point), 2.0, 1e-15); });
  expect_in_coordinate_plane(mesh, "symmetry x", 0);
  expect_in_coordinate_plane(mesh, "symmetry y", 1);
  expect_in_coordinate_plane(mesh, "symmetry z", 2);
}

/// The order at which an error falls when the mesh is refined by 2.
double order(double coarse, double fine, double exact) { return std::log2(std::abs(coarse - exact) / std::abs(fine - exact)); }

TEST(VerificationShapes, SphereOctantApproachesTheVolumeWithSecondOrder) {
  // Flat faces miss the sphere by h^2 / 8, so the observed order is 2 but for terms of the next order, h^4.
  const double exact = 4.0 / 3.0 * pi * 7.0 / 8.0;
  const HexahedralMesh coarse = thick_sphere_octant(1.0, 2.0, 8, 8);
  const HexahedralMesh fine = thick_sphere_octant(1.0, 2.0, 16, 16);
  EXPECT_NEAR(order(solid_volume(coarse), solid_volume(fine), exact), 2.0, 0.02);
  const double air = 4.0 / 3.0 * pi / 8.0;
  EXPECT_NEAR(order(enclosed_volume(coarse, coarse.chambers[0]), enclosed_volume(fine, fine.chambers[0]), air), 2.0, 0.02);
}

TEST(VerificationShapes, CylinderQuarterHasThePrismVolumesInClosedForm) {
  // Inscribed polygons: each of n triangles has the area r^2 sin(pi / 2n) / 2.
  const std::size_t n = 6;
  const HexahedralMesh mesh = thick_cylinder_quarter(1.0, 2.0, 0.5, {3, n, 2});
  const double polygon = 0.5 * static_cast<double>(n) * std::sin(0.5 * pi / static_cast<double>(n));
  EXPECT_NEAR(solid_volume(mesh), 0.5 * (4.0 - 1.0) * polygon, 1e-14);
  EXPECT_NEAR(enclosed_volume(mesh, mesh.chambers[0]), 0.5 * polygon, 1e-14);
  EXPECT_EQ(mesh.geometry, Geometry::cylindrical);
  expect_sound(mesh);
  EXPECT_NO_THROW(require_no_inverted_elements(mesh, "cylinder"));
  EXPECT_NO_THROW(require_closed_chambers(mesh, "cylinder"));
  for_each_point_of(mesh, "chamber 0", [](const Point& point) { EXPECT_NEAR(std::hypot(point[0], point[1]), 1.0, 1e-15); });
  for_each_point_of(mesh, "outer", [](const Point& point) { EXPECT_NEAR(std::hypot(point[0], point[1]), 2.0, 1e-15); });
  expect_in_coordinate_plane(mesh, "symmetry x", 0);
  expect_in_coordinate_plane(mesh, "symmetry y", 1);
  expect_in_coordinate_plane(mesh, "symmetry z", 2);
  for_each_point_of(mesh, "end", [](const Point& point) { EXPECT_EQ(point[2], 0.5); });
}

TEST(VerificationShapes, QuarterOfTheHollowCubeIsAQuarterOfIt) {
  for (const std::size_t n : {1U, 2U}) {
    HollowBodyOptions options;
    options.elements_through_wall = static_cast<int>(n);
    const HollowBody whole = hollow_polycube(hollow_cube_design(0.02), options);
    const HexahedralMesh quarter = hollow_cube_quarter(0.02, 0.002, n);
    EXPECT_EQ(4 * quarter.elements.size(), whole.mesh.elements.size());
    EXPECT_NEAR(4.0 * solid_volume(quarter), whole.wall_volume_m3, 1e-12 * whole.wall_volume_m3);
    EXPECT_NEAR(4.0 * enclosed_volume(quarter, quarter.chambers[0]), std::pow(0.016, 3), 1e-18);
    EXPECT_NEAR(4.0 * label_area(quarter, "ground"), 4e-4, 1e-15);
    EXPECT_NEAR(4.0 * label_area(quarter, "outer"), 5 * 4e-4, 1e-15);
    expect_sound(quarter);
    EXPECT_NO_THROW(require_closed_chambers(quarter, "quarter"));
    expect_in_coordinate_plane(quarter, "symmetry x", 0);
    expect_in_coordinate_plane(quarter, "symmetry y", 1);
  }
}

TEST(BoundaryLabels, UnknownOnesAreRefusedWithThoseThatExist) {
  const HexahedralMesh mesh = box({1.0, 1.0, 1.0}, {1, 1, 1});
  EXPECT_EQ(label_index(mesh, "z max"), 5U);
  try {
    static_cast<void>(label_index(mesh, "top"));
    FAIL() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              R"(the mesh has no boundary label "top"; it has "x min", "x max", "y min", "y max", "z min", "z max")");
  }
  EXPECT_THROW(static_cast<void>(region_index(mesh, "lid")), io::InputError);
}

}  // namespace
}  // namespace menger::meshes
