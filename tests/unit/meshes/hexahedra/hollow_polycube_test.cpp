#include "meshes/hexahedra/hollow_polycube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "tests/unit/meshes/hexahedra/mesh_checks.h"

namespace menger::meshes {
namespace {

/// Rounding of a sum of some thousand volumes of like size.
constexpr double volume_tolerance = 1e-12;

Design upright18() { return {"stand18", Polycube::from_digits(3, 3, 3, "101000101111111111011111000"), 0.01}; }

/// A count of small cubes, straight from the definition: a cube belongs to the chamber of its region if no cube within t of it
/// (in the max norm) lies outside its module and none within t / 2 in another region of it. Regions end t / 2 beside those planes
/// between cells whose partitions are not centred.
class CubeCount {
 public:
  /// @param cell_cubes cubes along the edge of a cell @param wall_cubes along the wall thickness, even
  CubeCount(const Polycube& basal, int level, bool per_phase, int cell_cubes, int wall_cubes)
      : body_(basal, level, per_phase ? ChamberLayout::per_phase : ChamberLayout::single),
        basal_(basal),
        cells_(fractal(basal, level)),
        per_phase_(per_phase),
        cell_cubes_(cell_cubes),
        wall_cubes_(wall_cubes) {
    for (int z = 0; z < cells_.nz() * cell_cubes; ++z) {
      for (int y = 0; y < cells_.ny() * cell_cubes; ++y) {
        for (int x = 0; x < cells_.nx() * cell_cubes; ++x) {
          if (cells_.at({x / cell_cubes, y / cell_cubes, z / cell_cubes}) == empty) continue;
          ++(is_chamber(x, y, z) ? chamber : wall);
        }
      }
    }
  }

  std::size_t chamber = 0;
  std::size_t wall = 0;

 private:
  [[nodiscard]] int cell_along(int cube) const { return static_cast<int>(std::floor(static_cast<double>(cube) / cell_cubes_)); }

  /// The cell to whose region a cube belongs, along one axis.
  [[nodiscard]] int owner_along(std::size_t axis, int cube) const {
    const int cell = cell_along(cube);
    const int above_plane = cube - cell * cell_cubes_;
    if (body_.partition_place(axis, cell) == PartitionPlace::high && 2 * above_plane < wall_cubes_) return cell - 1;
    const int below_plane = cell_cubes_ - above_plane - 1;
    if (body_.partition_place(axis, cell + 1) == PartitionPlace::low && 2 * below_plane < wall_cubes_) return cell + 1;
    return cell;
  }

  /// The module of a cell; nothing outside.
  [[nodiscard]] std::vector<int> module_of(const CellIndex& cell) const {
    if (cells_.at_or_empty(cell) == empty) return {};
    return {cell.x / basal_.nx(), cell.y / basal_.ny(), cell.z / basal_.nz()};
  }

  [[nodiscard]] CellIndex owner_of(int x, int y, int z) const {
    return {owner_along(0, x), owner_along(1, y), owner_along(2, z)};
  }

  [[nodiscard]] bool is_chamber(int x, int y, int z) const {
    const std::vector<int> module = module_of({cell_along(x), cell_along(y), cell_along(z)});
    const CellIndex owner = owner_of(x, y, z);
    for (int k = -wall_cubes_; k <= wall_cubes_; ++k) {
      for (int j = -wall_cubes_; j <= wall_cubes_; ++j) {
        for (int i = -wall_cubes_; i <= wall_cubes_; ++i) {
          if (module_of({cell_along(x + i), cell_along(y + j), cell_along(z + k)}) != module) return false;
          if (!per_phase_ || 2 * std::max({std::abs(i), std::abs(j), std::abs(k)}) > wall_cubes_) continue;
          // The material is enough to tell regions that touch apart. Empty owners lie beside outer walls.
          const Material other = cells_.at_or_empty(owner_of(x + i, y + j, z + k));
          if (other != empty && other != cells_.at_or_empty(owner)) return false;
        }
      }
    }
    return true;
  }

  ModularBody body_;
  const Polycube& basal_;
  Polycube cells_;
  bool per_phase_;
  int cell_cubes_;
  int wall_cubes_;
};

void expect_whole_volumes(const HollowBody& body) {
  EXPECT_NEAR(solid_volume(body.mesh), body.wall_volume_m3, volume_tolerance * body.wall_volume_m3);
  ASSERT_EQ(body.chambers.size(), body.mesh.chambers.size());
  for (std::size_t chamber = 0; chamber < body.chambers.size(); ++chamber) {
    // A surface integral cancels: its terms are as large as area times the distance from the origin.
    EXPECT_NEAR(enclosed_volume(body.mesh, body.mesh.chambers[chamber]), body.chambers[chamber].volume_m3,
                1e-11 * body.chambers[chamber].volume_m3);
  }
}

TEST(HollowPolycube, ReproducesTheHollowCubeOfOthers) {
  HollowBodyOptions options;
  for (const auto& [n, elements, points] : {std::tuple<int, std::size_t, std::size_t>{1, 488, 988}, {2, 3904, 5886}}) {
    options.elements_through_wall = n;
    const HollowBody body = hollow_polycube(hollow_cube_design(0.02), options);
    EXPECT_EQ(body.mesh.elements.size(), elements);
    EXPECT_EQ(body.mesh.points.size(), points);
    for (std::size_t element = 0; element < elements; ++element) {
      const auto [shortest, longest] = edge_range(corner_points(body.mesh, element));
      ASSERT_NEAR(shortest, 0.002 / n, 1e-17);
      ASSERT_NEAR(longest, 0.002 / n, 1e-17);
    }
    EXPECT_NEAR(body.chambers[0].volume_m3, std::pow(0.016, 3), 1e-20);
    EXPECT_NEAR(body.wall_volume_m3, std::pow(0.02, 3) - std::pow(0.016, 3), 1e-20);
    expect_sound(body.mesh);
    expect_whole_volumes(body);
    EXPECT_NO_THROW(require_closed_chambers(body.mesh, "cube"));
  }
}

TEST(HollowPolycube, IsTheSameForOneLargeCellAndEightSmallOnes) {
  const HollowBody one = hollow_polycube(hollow_cube_design(0.02), {});
  const HollowBody eight = hollow_polycube({"eight", full_cube(2), 0.01}, {});
  EXPECT_EQ(one.mesh.elements, eight.mesh.elements);
  ASSERT_EQ(one.mesh.points.size(), eight.mesh.points.size());
  for (std::size_t i = 0; i < one.mesh.points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(one.mesh.points[i][axis], eight.mesh.points[i][axis], 1e-17);
  }
}

TEST(HollowPolycube, VolumesAreThoseOfAnIndependentCount) {
  const std::vector<Polycube> bodies{bar(3), Polycube::from_digits(3, 3, 1, "112100122"), menger_sponge(), upright18().body,
                                     Polycube::from_digits(3, 3, 3, "112212221121212212222121112"),
                                     // phases and outer walls in one plane: one side has more outer walls, or both as many
                                     Polycube::from_digits(2, 2, 1, "1210"), Polycube::from_digits(2, 3, 2, "120012122112"),
                                     Polycube::from_digits(3, 3, 2, "100000002112112222")};
  for (const Polycube& body : bodies) {
    for (const ChamberLayout layout : {ChamberLayout::single, ChamberLayout::per_phase}) {
      HollowBodyOptions options;
      options.chambers = layout;
      options.elements_through_wall = 2;
      const HollowBody hollow = hollow_polycube({"body", body, 0.01}, options);
      const CubeCount count(body, 1, layout == ChamberLayout::per_phase, 10, 2);
      double chambers = 0.0;
      for (const ChamberOrigin& chamber : hollow.chambers) chambers += chamber.volume_m3;
      EXPECT_NEAR(hollow.wall_volume_m3, 1e-9 * static_cast<double>(count.wall), volume_tolerance * hollow.wall_volume_m3);
      EXPECT_NEAR(chambers, 1e-9 * static_cast<double>(count.chamber), volume_tolerance * chambers);
      expect_whole_volumes(hollow);
      expect_sound(hollow.mesh);
      EXPECT_NO_THROW(require_closed_chambers(hollow.mesh, "body"));
    }
  }
}

TEST(HollowPolycube, ChamberOfOneRegionIsTheSumOverItsCellsSidesEdgesAndCorners) {
  // Each cell gives a core, each side between two cells a channel, each edge of four cells and each corner of eight a little
  // more.
  const double a = 0.00667, t = 0.002, core = a - 2 * t;
  const HollowBody cube = hollow_polycube({"cube", full_cube(3), a}, {});
  const double closed_form =
      27 * std::pow(core, 3) + 54 * core * core * 2 * t + 36 * core * std::pow(2 * t, 2) + 8 * std::pow(2 * t, 3);
  EXPECT_NEAR(cube.chambers[0].volume_m3, closed_form, volume_tolerance * closed_form);
  EXPECT_NEAR(closed_form, std::pow(3 * a - 2 * t, 3), volume_tolerance * closed_form);
  expect_whole_volumes(cube);
}

TEST(HollowPolycube, MeetsItsVolumesOnGradedMeshesOfAnyEdge) {
  HollowBodyOptions options;
  options.largest_element_m = 0.004;
  options.growth = 1.4;
  for (const double edge : {0.00667, 0.01, 0.0123}) {
    for (const int n : {1, 2, 3}) {
      for (const ChamberLayout layout : {ChamberLayout::single, ChamberLayout::per_phase}) {
        options.elements_through_wall = n;
        options.chambers = layout;
        const HollowBody body = hollow_polycube({"l", Polycube::from_digits(2, 2, 2, "12210100"), edge}, options);
        expect_whole_volumes(body);
        expect_sound(body.mesh);
      }
    }
  }
}

TEST(HollowPolycube, GradingSavesElements) {
  HollowBodyOptions options;
  options.elements_through_wall = 4;
  const std::size_t uniform = hollow_polycube(hollow_cube_design(0.02), options).mesh.elements.size();
  options.largest_element_m = 0.002;
  const HollowBody graded = hollow_polycube(hollow_cube_design(0.02), options);
  EXPECT_LT(graded.mesh.elements.size(), uniform / 3);
  double longest = 0.0;
  for (std::size_t e = 0; e < graded.mesh.elements.size(); ++e)
    longest = std::max(longest, edge_range(corner_points(graded.mesh, e)).second);
  EXPECT_LE(longest, 0.002);
}

TEST(HollowPolycube, PerPhaseMakesAChamberOfEveryConnectedRegion) {
  HollowBodyOptions options;
  options.chambers = ChamberLayout::per_phase;
  const HollowBody body = hollow_polycube({"bar", Polycube::from_digits(4, 1, 1, "1221"), 0.01}, options);
  ASSERT_EQ(body.chambers.size(), 3U);
  EXPECT_EQ(body.chambers[0].material, 1);
  EXPECT_EQ(body.chambers[1].material, 2);
  EXPECT_EQ(body.chambers[2].material, 1);
  // A wall of 2 mm between chambers takes 1 mm from each: 7 x 6 x 6, 18 x 6 x 6 and 7 x 6 x 6 mm.
  EXPECT_NEAR(body.chambers[0].volume_m3, 252e-9, 1e-20);
  EXPECT_NEAR(body.chambers[1].volume_m3, 648e-9, 1e-20);
  EXPECT_NEAR(body.chambers[2].volume_m3, 252e-9, 1e-20);
  EXPECT_EQ(body.mesh.plenum_names.size(), 3U);
  expect_whole_volumes(body);
}

/// A body of two phases, the digits of its layers from the ground up, with walls of 2 mm.
HollowBody two_phases(const std::array<int, 3>& cells, const std::string& digits) {
  HollowBodyOptions options;
  options.chambers = ChamberLayout::per_phase;
  return hollow_polycube({"two phases", Polycube::from_digits(cells[0], cells[1], cells[2], digits), 0.01}, options);
}

void expect_volumes_mm3(const HollowBody& body, const std::vector<double>& chambers, double wall) {
  ASSERT_EQ(body.chambers.size(), chambers.size());
  for (std::size_t n = 0; n < chambers.size(); ++n)
    EXPECT_NEAR(body.chambers[n].volume_m3, 1e-9 * chambers[n], 1e-19) << "chamber " << n;
  EXPECT_NEAR(body.wall_volume_m3, 1e-9 * wall, 1e-19);
  expect_whole_volumes(body);
  expect_sound(body.mesh);
  EXPECT_NO_THROW(require_closed_chambers(body.mesh, "two phases"));
}

// The edges of the chambers, in mm: 2 mm within the outside, and 2 mm between chambers in the cells beside outer walls.
TEST(HollowPolycube, PartitionsLieInTheCellsOnTheSideOfOuterWalls) {
  // A plate on four feet. The partition across x is centred; that across y lies in the row of the hind feet.
  expect_volumes_mm3(two_phases({4, 3, 2}, "100200002001112211222211"),
                     {17 * 18 * 6 + 6 * 6 * 10, 17 * 18 * 6 + 6 * 6 * 10, 17 * 6 * 6 + 6 * 6 * 10, 17 * 6 * 6 + 6 * 6 * 10},
                     9664);
  // The partitions across x lie in the columns of the feet, that across y in their rows.
  expect_volumes_mm3(two_phases({4, 4, 2}, "10021002000000001112111212221222"),
                     {(28 * 16 + 6 * 20) * 6 + 6 * 16 * 10, (6 * 36 + 22 * 18) * 6 + 6 * 16 * 10}, 11000);
  // The partition lies in the right one of two skids.
  expect_volumes_mm3(two_phases({4, 3, 2}, "100210021002111211121112"), {28 * 26 * 6 + 6 * 26 * 10, 6 * 26 * 6 + 6 * 26 * 10},
                     9576);
}

TEST(HollowPolycube, OfRandomPhasesHaveTheVolumesOfAnIndependentCount) {
  std::mt19937 random(7);
  int meshed = 0;
  int moved = 0;
  while (meshed < 40) {
    std::string digits;
    while (digits.size() < 12) digits += "0112122"[random() % 7];
    const Polycube body = Polycube::from_digits(2, 3, 2, digits);
    HollowBodyOptions options;
    options.chambers = ChamberLayout::per_phase;
    try {
      const HollowBody hollow = hollow_polycube({"body", body, 0.01}, options);
      const CubeCount count(body, 1, true, 5, 2);
      expect_whole_volumes(hollow);
      expect_sound(hollow.mesh);
      // walls of two fifths of a cell, which volumes in closed form have, too
      options.wall_thickness_m = 0.004;
      const double wall_m3 = hollow_polycube({"body", body, 0.01}, options).wall_volume_m3;
      EXPECT_NEAR(wall_m3, 8e-9 * static_cast<double>(count.wall), volume_tolerance * wall_m3) << digits;
      const ModularBody cells(body, 1, ChamberLayout::per_phase);
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int plane : {1, 2}) moved += cells.partition_place(axis, plane) != PartitionPlace::centred;
      ++meshed;
    } catch (const io::InputError&) {  // it is not connected, or touches itself at an edge only
    }
  }
  EXPECT_GT(moved, 20);
}

TEST(HollowPolycube, LabelsTheGroundAndTheOuterFaces) {
  const HollowBody body = hollow_polycube(upright18(), {});
  // Four feet of 1 cm^2 stand on the ground.
  EXPECT_NEAR(label_area(body.mesh, "ground"), 4e-4, 1e-15);
  for (const BoundaryFace& face : body.mesh.faces) {
    if (body.mesh.label_names[face.label] != "ground") continue;
    EXPECT_LT(area_vector(body.mesh, face)[2], 0.0);
    for (const std::size_t corner : face.corners) EXPECT_EQ(body.mesh.points[corner][2], 0.0);
  }
  std::size_t sides = 0;
  for (const CellIndex& cell : upright18().body.occupied()) {
    for (const Side side : all_sides) {
      const int step = is_max(side) ? 1 : -1;
      CellIndex other = cell;
      (axis_of(side) == 0 ? other.x : axis_of(side) == 1 ? other.y : other.z) += step;
      if (upright18().body.at_or_empty(other) == empty) ++sides;
    }
  }
  EXPECT_NEAR(label_area(body.mesh, "outer"), 1e-4 * static_cast<double>(sides) - 4e-4, 1e-14);
}

TEST(HollowPolycube, TubeHoleOpensTheWallAndItsCapClosesTheChamber) {
  for (const Side side : all_sides) {
    HollowBodyOptions options;
    options.tubes = {{{0, 0, 0}, side, 0.004}};
    const HollowBody body = hollow_polycube(hollow_cube_design(0.02), options);
    EXPECT_NEAR(body.chambers[0].volume_m3, std::pow(0.016, 3) + 0.004 * 0.004 * 0.002, 1e-19);
    EXPECT_NEAR(label_area(body.mesh, "tube"), 4 * 0.004 * 0.002, 1e-16);
    ASSERT_EQ(body.mesh.chambers[0].caps.size(), 1U);
    EXPECT_EQ(body.mesh.chambers[0].labels.size(), 2U);
    expect_sound(body.mesh);
    expect_whole_volumes(body);
    EXPECT_NO_THROW(require_closed_chambers(body.mesh, to_string(side).data()));
    HexahedralMesh without_cap = body.mesh;
    without_cap.chambers[0].caps.clear();
    EXPECT_THROW(require_closed_chambers(without_cap, "cube"), io::InputError);
  }
}

TEST(HollowPolycube, LidIsTheBottomOrTopWall) {
  for (const LidPlace place : {LidPlace::bottom, LidPlace::top}) {
    HollowBodyOptions options;
    options.lid = place;
    const HexahedralMesh mesh = hollow_polycube(hollow_cube_design(0.02), options).mesh;
    const std::size_t lid = region_index(mesh, "lid");
    double volume = 0.0;
    for (std::size_t element = 0; element < mesh.elements.size(); ++element) {
      if (mesh.regions[element] != lid) continue;
      volume += element_volume(corner_points(mesh, element));
      for (const Point& corner : corner_points(mesh, element)) {
        const double depth = place == LidPlace::bottom ? corner[2] : 0.02 - corner[2];
        EXPECT_LT(depth, 0.002 + 1e-12);
      }
    }
    EXPECT_NEAR(volume, 0.02 * 0.02 * 0.002, 1e-18);
  }
}

}  // namespace
}  // namespace menger::meshes
