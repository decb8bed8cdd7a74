#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "io/text/input_error.h"
#include "meshes/design/reference_shapes.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "tests/unit/meshes/hexahedra/mesh_checks.h"

namespace menger::meshes {
namespace {

Design stand18() { return {"stand18", Polycube::from_digits(3, 3, 3, "101000101111111111011111000"), 0.01}; }

HollowBodyOptions level_2() {
  HollowBodyOptions options;
  options.level = 2;
  return options;
}

void expect_volumes(const HollowBody& body) {
  EXPECT_NEAR(solid_volume(body.mesh), body.wall_volume_m3, 1e-12 * body.wall_volume_m3);
  for (std::size_t chamber = 0; chamber < body.chambers.size(); ++chamber) {
    // A surface integral cancels: its terms are as large as area times the distance from the origin.
    EXPECT_NEAR(enclosed_volume(body.mesh, body.mesh.chambers[chamber]), body.chambers[chamber].volume_m3,
                1e-10 * body.chambers[chamber].volume_m3);
  }
}

std::size_t coinciding_points(const HexahedralMesh& mesh) {
  const std::set<Point> places(mesh.points.begin(), mesh.points.end());
  return mesh.points.size() - places.size();
}

TEST(Aggregate, ModulesKeepTheirWallsAndShareThePointsOfTheirJoint) {
  // A bar of two cells at level 2: two modules end to end, each with its own chamber of 16 x 6 x 6 mm.
  const HollowBody body = hollow_polycube({"bar", bar(2), 0.01}, level_2());
  EXPECT_EQ(body.module_count, 2U);
  ASSERT_EQ(body.chambers.size(), 2U);
  for (const ChamberOrigin& chamber : body.chambers) EXPECT_NEAR(chamber.volume_m3, 576e-9, 1e-20);
  EXPECT_NEAR(body.wall_volume_m3, 4000e-9 - 2 * 576e-9, 1e-19);
  EXPECT_EQ(coinciding_points(body.mesh), 0U);
  EXPECT_EQ(body.hole_count, 0U);
  EXPECT_EQ(body.mesh.plenum_names.size(), 2U);
  expect_sound(body.mesh);
  expect_volumes(body);
}

TEST(Aggregate, HolesJoinChambersToPlenumsAndCapsDivideTheirAir) {
  HollowBodyOptions options = level_2();
  options.hole_edge_m = 0.002;
  const HollowBody body = hollow_polycube({"bar", bar(2), 0.01}, options);
  EXPECT_EQ(body.hole_count, 1U);
  EXPECT_EQ(body.mesh.plenum_names, std::vector<std::string>{"plenum 0"});
  for (const ChamberOrigin& chamber : body.chambers) EXPECT_NEAR(chamber.volume_m3, 576e-9 + 8e-9, 1e-20);
  EXPECT_NEAR(body.wall_volume_m3, 4000e-9 - 2 * 584e-9, 1e-19);
  expect_sound(body.mesh);
  expect_volumes(body);
  EXPECT_NO_THROW(require_closed_chambers(body.mesh, "bar"));

  // The two caps are one patch seen from both sides, in the plane of the joint.
  ASSERT_EQ(body.mesh.chambers[0].caps.size(), 1U);
  ASSERT_EQ(body.mesh.chambers[1].caps.size(), 1U);
  auto rim = body.mesh.chambers[0].caps[0].rim;
  auto other = body.mesh.chambers[1].caps[0].rim;
  for (auto& edge : other) std::swap(edge[0], edge[1]);
  std::sort(rim.begin(), rim.end());
  std::sort(other.begin(), other.end());
  EXPECT_EQ(rim, other);
  for (const auto& edge : rim) EXPECT_DOUBLE_EQ(body.mesh.points[edge[0]][0], 0.02);
}

TEST(Aggregate, HolesMayBeAsWideAsTheChamber) {
  HollowBodyOptions options = level_2();
  options.hole_edge_m = 0.006;
  options.tubes = {{{0, 0, 0}, Side::z_max, 0.006}};
  const HollowBody body = hollow_polycube({"bar", bar(2), 0.01}, options);
  expect_sound(body.mesh);
  expect_volumes(body);
  EXPECT_NO_THROW(require_closed_chambers(body.mesh, "bar"));
}

TEST(Aggregate, HolesJoinEqualPhasesOnly) {
  HollowBodyOptions options = level_2();
  options.chambers = ChamberLayout::per_phase;
  options.hole_edge_m = 0.002;
  // Modules 12|12: the phases that meet differ. In 11|11 of equal ones they do not.
  EXPECT_EQ(hollow_polycube({"bar", Polycube::from_digits(2, 1, 1, "12"), 0.01}, options).hole_count, 0U);
  EXPECT_EQ(hollow_polycube({"bar", bar(2), 0.01}, options).hole_count, 1U);
  options.chambers = ChamberLayout::single;
  EXPECT_EQ(hollow_polycube({"bar", Polycube::from_digits(2, 1, 1, "12"), 0.01}, options).hole_count, 1U);
}

TEST(Aggregate, HolesStayInTheHorizontalPlane) {
  HollowBodyOptions options = level_2();
  options.hole_edge_m = 0.002;
  const HollowBody tower = hollow_polycube({"tower", Polycube::from_digits(1, 1, 2, "11"), 0.01}, options);
  EXPECT_EQ(tower.hole_count, 0U);
  EXPECT_EQ(tower.mesh.plenum_names.size(), 2U);
}

TEST(Aggregate, Stand18HasAPlenumForEveryGroupOfModulesInAPlane) {
  HollowBodyOptions options = level_2();
  options.hole_edge_m = 0.002;
  const HollowBody body = hollow_polycube(stand18(), options);
  EXPECT_EQ(body.module_count, 18U);
  ASSERT_EQ(body.chambers.size(), 18U);
  // Below four feet that do not touch, above them a plane of 9 modules with 12 joints and one of 5 with 5 joints.
  EXPECT_EQ(body.mesh.plenum_names.size(), 6U);
  EXPECT_EQ(body.hole_count, 17U);
  std::map<std::size_t, std::size_t> modules_of;
  for (const Chamber& chamber : body.mesh.chambers) ++modules_of[chamber.plenum];
  std::multiset<std::size_t> sizes;
  for (const auto& [plenum, modules] : modules_of) sizes.insert(modules);
  EXPECT_EQ(sizes, (std::multiset<std::size_t>{1, 1, 1, 1, 5, 9}));
  expect_sound(body.mesh);
  expect_volumes(body);
  EXPECT_NO_THROW(require_closed_chambers(body.mesh, "stand18"));
}

TEST(Aggregate, ModulesThatTouchAlongAnEdgeOnlyAreNotBondedThere) {
  // Above cell (1, 0, 2) of one stand18 nothing of the next lies, but it touches cell (0, 0, 0) of that along an edge.
  const HollowBody body = hollow_polycube(stand18(), level_2());
  EXPECT_GT(coinciding_points(body.mesh), 0U);
  // Each point's elements are joined through faces at that point: no two parts of the body hang together by a point or an edge.
  std::map<std::size_t, std::map<std::size_t, std::vector<FaceKey>>> faces_at;
  for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
    const ElementCorners& corners = body.mesh.elements[e];
    for (const auto& face : face_corners) {
      const FaceKey key = sorted({corners[face[0]], corners[face[1]], corners[face[2]], corners[face[3]]});
      for (const std::size_t corner : key) faces_at[corner][e].push_back(key);
    }
  }
  for (const auto& [point, elements] : faces_at) {
    std::set<std::size_t> reached{elements.begin()->first};
    std::vector<std::size_t> front{elements.begin()->first};
    while (!front.empty()) {
      const std::size_t element = front.back();
      front.pop_back();
      for (const auto& [other, faces] : elements) {
        const auto shares = [&others = faces](const FaceKey& face) {
          return std::find(others.begin(), others.end(), face) != others.end();
        };
        const auto& own = elements.at(element);
        if (!reached.contains(other) && std::any_of(own.begin(), own.end(), shares)) {
          reached.insert(other);
          front.push_back(other);
        }
      }
    }
    ASSERT_EQ(reached.size(), elements.size()) << "point " << point;
  }
}

TEST(Aggregate, JointRegionIsTheBondedWalls) {
  HollowBodyOptions options = level_2();
  options.joint_region = true;
  const HexahedralMesh mesh = hollow_polycube({"bar", bar(2), 0.01}, options).mesh;
  const std::size_t joint = region_index(mesh, "joint");
  double volume = 0.0;
  for (std::size_t element = 0; element < mesh.elements.size(); ++element) {
    if (mesh.regions[element] == joint) volume += element_volume(corner_points(mesh, element));
  }
  EXPECT_NEAR(volume, 2 * 0.002 * 0.01 * 0.01, 1e-18);
}

TEST(Aggregate, OneThatFallsApartIsRefused) {
  // A step is connected, but where a copy of it ends to the right the next has not begun.
  const Design step{"step", Polycube::from_digits(3, 2, 1, "110011"), 0.01};
  EXPECT_NO_THROW(static_cast<void>(hollow_polycube(step, {})));
  try {
    static_cast<void>(hollow_polycube(step, level_2()));
    FAIL() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("design step: at level 2 the body consists of"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace menger::meshes
