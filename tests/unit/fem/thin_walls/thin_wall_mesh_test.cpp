#include "fem/thin_walls/thin_wall_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "fem/thin_walls/element_choice.h"
#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/support/input_error_message.h"

namespace menger::fem {
namespace {

meshes::HexahedralMesh hollow(const std::string& digits, const std::array<int, 3>& cells,
                              meshes::HollowBodyOptions options = {}) {
  const meshes::Design design{"body", meshes::Polycube::from_digits(cells[0], cells[1], cells[2], digits), 10e-3};
  options.wall_thickness_m = 2e-3;
  set_elements({}, options);
  return meshes::hollow_polycube(design, options).mesh;
}

/// How many elements there are of each place.
std::map<ThinWallPlace, std::size_t> counts(const meshes::HexahedralMesh& mesh) {
  std::map<ThinWallPlace, std::size_t> result;
  for (const ThinWallPlace& place : thin_wall_places(mesh)) ++result[place];
  return result;
}

constexpr ThinWallPlace block{};

ThinWallPlace wall(std::size_t normal, int first_plenum, int second_plenum) {
  return {ThinWallElement::wall, normal, {first_plenum, second_plenum}};
}

// Six walls of 3 x 3 elements, twelve edges of 3 and eight corners.
TEST(ThinWallMesh, HollowCubeHasWallsAndBlocksAtItsEdges) {
  const std::map<ThinWallPlace, std::size_t> found = counts(hollow("1", {1, 1, 1}));
  const std::map<ThinWallPlace, std::size_t> expected{
      {wall(0, 0, -1), 18}, {wall(1, 0, -1), 18}, {wall(2, 0, -1), 18}, {block, 44}};
  EXPECT_EQ(found, expected);
}

// Two chambers: the wall between them has a chamber on each side.
TEST(ThinWallMesh, WallsBetweenChambersKnowBothPlena) {
  meshes::HollowBodyOptions options;
  options.chambers = meshes::ChamberLayout::per_phase;
  const std::map<ThinWallPlace, std::size_t> found = counts(hollow("12", {2, 1, 1}, options));
  EXPECT_EQ(found.at(wall(0, 1, 0)), 9U);
  EXPECT_EQ(found.at(wall(0, 0, -1)), 9U);
  EXPECT_EQ(found.at(wall(0, 1, -1)), 9U);
}

// The walls that two modules have in common are two layers: blocks, as thick as they are.
TEST(ThinWallMesh, JointsAreBlocks) {
  meshes::HollowBodyOptions options;
  options.level = 2;
  const std::map<ThinWallPlace, std::size_t> found = counts(hollow("11", {2, 1, 1}, options));
  EXPECT_EQ(found.count(wall(0, 1, 0)), 0U);
  EXPECT_EQ(found.at(wall(0, 0, -1)), 9U);
}

TEST(ThinWallMesh, PlanesOfSymmetryAreNoFreeFaces) {
  const meshes::HexahedralMesh mesh = meshes::hollow_cube_quarter(20e-3, 2e-3, 1);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ThinWallPlace place = thin_wall_places(mesh)[e];
    const meshes::Point middle = meshes::corner_points(mesh, e)[0];
    if (place.element == ThinWallElement::wall && place.normal == 0) {
      EXPECT_NEAR(middle[0], 8e-3, 1e-9);
    }
  }
  EXPECT_GT(counts(mesh).at(wall(0, 0, -1)), 0U);
}

TEST(ThinWallMesh, SolidsAndBarsAreBlocks) {
  EXPECT_EQ(counts(meshes::box({3e-3, 3e-3, 3e-3}, {3, 3, 3})).at(block), 27U);
  EXPECT_EQ(counts(meshes::box({9e-3, 1e-3, 1e-3}, {9, 1, 1})).at(block), 9U) << "free along two axes, or three at the ends";
  const auto plate = counts(meshes::box({3e-3, 3e-3, 1e-3}, {3, 3, 1}));
  EXPECT_EQ(plate.at(wall(2, -1, -1)), 9U);
}

TEST(ThinWallMesh, BatchesHoldEveryElementOnce) {
  const meshes::HexahedralMesh mesh = hollow("110", {3, 1, 1});
  const std::vector<ThinWallPlace> places = thin_wall_places(mesh);
  for (const std::size_t width : {1U, 4U, 16U}) {
    const ThinWallMesh walls(mesh, width);
    std::multiset<std::size_t> found;
    std::size_t batches = 0;
    for (const ThinWallGroup& group : walls.groups()) {
      EXPECT_EQ(group.first_batch, batches);
      batches += group.batch_count;
      for (std::size_t lane = width * group.first_batch; lane < width * batches; ++lane) {
        const std::size_t element = walls.element(lane);
        const ThinWallPlace& place = places[element];
        EXPECT_EQ(place.element, group.element);
        EXPECT_EQ(place.normal, walls.normal(lane / width));
        EXPECT_EQ(place.plena, walls.plena(lane / width));
        const meshes::Point edges = *meshes::box_edges(meshes::corner_points(mesh, element));
        EXPECT_DOUBLE_EQ(walls.shape(lane)[2], 0.25 / edges[place.normal]);
        EXPECT_DOUBLE_EQ(walls.shape(lane)[3], walls.is_repeated(lane) ? 0.0 : edges[0] * edges[1] * edges[2]);
        for (std::size_t c = 0; c < 8; ++c)
          EXPECT_EQ(walls.first_components(lane)[c], 3 * mesh.elements[element][global_corner(place.normal, c)]);
        if (!walls.is_repeated(lane)) found.insert(element);
      }
    }
    EXPECT_EQ(batches, walls.batch_count());
    EXPECT_EQ(found.size(), mesh.elements.size());
    EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()).size(), mesh.elements.size());
  }
}

meshes::HollowBodyOptions per_phase(int level = 1) {
  meshes::HollowBodyOptions options;
  options.chambers = meshes::ChamberLayout::per_phase;
  options.level = level;
  return options;
}

/// Returns whether a wall of a hollow body is cut into layers: two elements one behind the other, each with one free face, that
/// are together no thicker than a wall. Joints of modules are twice as thick.
bool has_layered_wall(const meshes::HexahedralMesh& mesh, double wall_thickness_m) {
  std::set<meshes::FaceCorners> free_faces;
  for (const meshes::BoundaryFace& face : mesh.faces) free_faces.insert(meshes::sorted(face.corners));
  std::map<meshes::FaceCorners, double> thickness_m;  // of the elements with one free face across an axis, by the other face
  for (std::size_t element = 0; element < mesh.elements.size(); ++element) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto face = [&](std::size_t side) {
        return meshes::sorted(meshes::face_of_element(mesh.elements[element], 2 * axis + side));
      };
      const bool is_low_free = free_faces.contains(face(0));
      if (is_low_free == free_faces.contains(face(1))) continue;
      const meshes::CornerPoints points = meshes::corner_points(mesh, element);
      double& both_m = thickness_m[face(is_low_free ? 1 : 0)];
      const bool is_second = both_m > 0.0;
      both_m += points[7][axis] - points[0][axis];
      if (is_second && both_m < 1.001 * wall_thickness_m) return true;
    }
  }
  return false;
}

TEST(ThinWallMesh, LayersAreFound) {
  meshes::HexahedralMesh plate = meshes::box({9e-3, 9e-3, 2e-3}, {3, 3, 2});
  EXPECT_TRUE(has_layered_wall(plate, 2e-3));
  EXPECT_FALSE(has_layered_wall(plate, 1e-3)) << "two walls in a joint";
  EXPECT_FALSE(has_layered_wall(meshes::box({9e-3, 9e-3, 2e-3}, {3, 3, 1}), 2e-3));
}

// Outer walls and partitions in one plane between cells: the grid lines of one must not cut the other.
TEST(ThinWallMesh, WallsHaveOneLayerWherePhasesAndOuterWallsMeet) {
  EXPECT_FALSE(has_layered_wall(hollow("1210", {2, 2, 1}, per_phase()), 2e-3));
  EXPECT_FALSE(has_layered_wall(hollow("100200002001112211222211", {4, 3, 2}, per_phase()), 2e-3));
  EXPECT_FALSE(has_layered_wall(hollow("10021002000000001112111212221222", {4, 4, 2}, per_phase()), 2e-3));
  EXPECT_FALSE(has_layered_wall(hollow("100210021002111211121112", {4, 3, 2}, per_phase()), 2e-3));
}

TEST(ThinWallMesh, WallsOfRandomPhasesHaveOneLayer) {
  std::mt19937 random(3);
  int meshed = 0;
  for (int n = 0; n < 300; ++n) {
    const std::array<int, 3> cells{2 + static_cast<int>(random() % 3), 2 + static_cast<int>(random() % 2), 2};
    const int level = n % 50 == 0 ? 2 : 1;
    std::string digits;
    while (digits.size() < static_cast<std::size_t>(cells[0] * cells[1] * cells[2])) digits += "001112122"[random() % 9];
    try {
      EXPECT_FALSE(has_layered_wall(hollow(digits, cells, per_phase(level)), 2e-3)) << digits;
      ++meshed;
    } catch (const io::InputError&) {  // it is not connected, or touches itself at an edge only
    }
  }
  EXPECT_GT(meshed, 100);
}

TEST(ThinWallMesh, RefusesWhatIsNoBox) {
  const meshes::HexahedralMesh membrane = meshes::cooks_membrane(1e-3, 1e-3, {4, 4, 1});
  EXPECT_NE(tests::message_of([&] { ThinWallMesh(membrane, 4); }).find("is not a box along the axes"), std::string::npos);
}

}  // namespace
}  // namespace menger::fem
