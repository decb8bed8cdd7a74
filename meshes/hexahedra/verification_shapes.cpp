#include "meshes/hexahedra/verification_shapes.h"

#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/grid_mesh.h"

namespace menger::meshes {
namespace {

GridLines equal_lines(double begin, double end, std::size_t count) {
  assert(count >= 1 && begin < end);
  GridLines lines;
  for (std::size_t i = 0; i < count; ++i)
    lines.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(count));
  lines.push_back(end);
  return lines;
}

/// Appends lines that begin where the first ones end.
void append(GridLines& lines, const GridLines& more) { lines.insert(lines.end(), more.begin() + 1, more.end()); }

void add_chamber(HexahedralMesh& mesh, std::size_t label) {
  mesh.plenum_names = {"plenum 0"};
  mesh.chambers = {{"chamber 0", {label}, {}, 0}};
}

/// Maps the points of a mesh to other coordinates. Faces keep their labels.
template <class Map>
void move_points(HexahedralMesh& mesh, const Map& map) {
  for (Point& point : mesh.points) point = map(point);
}

/// Builds the three blocks of the octant of a sphere. A direction is given by three numbers of steps, the largest of which is n.
class SphereOctant {
 public:
  SphereOctant(double inner, double outer, std::size_t radial, std::size_t tangential)
      : radii_(equal_lines(inner, outer, radial)), tangential_(tangential) {}

  HexahedralMesh build() {
    mesh_.region_names = {"wall"};
    mesh_.label_names = {"symmetry x", "symmetry y", "symmetry z", "chamber 0", "outer"};
    for (std::size_t axis = 0; axis < 3; ++axis) add_block(axis);
    add_chamber(mesh_, 3);
    mesh_.geometry = Geometry::spherical;
    return std::move(mesh_);
  }

 private:
  /// Adds the block around an axis. Its elements run along the next two axes and outwards.
  void add_block(std::size_t axis) {
    for (std::size_t layer = 0; layer + 1 < radii_.size(); ++layer) {
      for (std::size_t j = 0; j < tangential_; ++j) {
        for (std::size_t i = 0; i < tangential_; ++i) add_element(axis, i, j, layer);
      }
    }
  }

  void add_element(std::size_t axis, std::size_t i, std::size_t j, std::size_t layer) {
    const std::size_t first = (axis + 1) % 3;
    const std::size_t second = (axis + 2) % 3;
    ElementCorners corners{};
    for (std::size_t c = 0; c < corners.size(); ++c) {
      std::array<std::size_t, 3> steps{};
      steps[axis] = tangential_;
      steps[first] = i + (c & 1U);
      steps[second] = j + (c >> 1U & 1U);
      corners[c] = first_point(steps) + layer + (c >> 2U & 1U);
    }
    mesh_.elements.push_back(corners);
    mesh_.regions.push_back(0);
    if (i == 0) add_face(corners, Side::x_min, first);
    if (j == 0) add_face(corners, Side::y_min, second);
    if (layer == 0) add_face(corners, Side::z_min, 3);
    if (layer + 2 == radii_.size()) add_face(corners, Side::z_max, 4);
  }

  void add_face(const ElementCorners& corners, Side side, std::size_t label) {
    mesh_.faces.push_back({face_of_element(corners, static_cast<std::size_t>(side)), label});
  }

  /// Returns the innermost point in a direction; the other points of that direction follow it.
  std::size_t first_point(const std::array<std::size_t, 3>& steps) {
    const auto [entry, is_new] = first_points_.emplace(steps, mesh_.points.size());
    if (is_new) {
      Point direction{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // The steps have equal angles; n steps make the angle between an axis and the diagonal of a face.
        const double part = static_cast<double>(steps[axis]) / static_cast<double>(tangential_);
        direction[axis] = steps[axis] == tangential_ ? 1.0 : std::tan(0.25 * std::numbers::pi * part);
      }
      const double norm = length(direction);
      for (const double radius : radii_)
        mesh_.points.push_back({radius * direction[0] / norm, radius * direction[1] / norm, radius * direction[2] / norm});
    }
    return entry->second;
  }

  HexahedralMesh mesh_;
  GridLines radii_;
  std::size_t tangential_;
  std::map<std::array<std::size_t, 3>, std::size_t> first_points_;
};

/// Returns the rim of the cap at the end of a cylinder: the inner edges of the end faces.
Cap end_cap(const HexahedralMesh& mesh, std::size_t end_label, double inner_radius) {
  Cap cap;
  for (const BoundaryFace& face : mesh.faces) {
    if (face.label != end_label) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t from = face.corners[i];
      const std::size_t to = face.corners[(i + 1) % 4];
      const auto is_inside = [&](const Point& point) { return std::hypot(point[0], point[1]) < inner_radius * (1.0 + 1e-9); };
      // The cap points in the same direction as the end, so their shared edge has the opposite direction in the cap.
      if (is_inside(mesh.points[from]) && is_inside(mesh.points[to])) cap.rim.push_back({to, from});
    }
  }
  return cap;
}

}  // namespace

HexahedralMesh box(const Point& size, const std::array<std::size_t, 3>& elements) {
  MeshGrid grid;
  for (std::size_t axis = 0; axis < 3; ++axis) grid.lines[axis] = equal_lines(0.0, size[axis], elements[axis]);
  grid.contents.assign(grid.cell_count(), GridContent::solid(0));
  HexahedralMesh mesh;
  mesh.region_names = {"wall"};
  EndLabels ends{};
  for (const Side side : all_sides) {
    ends[static_cast<std::size_t>(side)] = mesh.label_names.size();
    mesh.label_names.emplace_back(to_string(side));
  }
  fill_from_grid(mesh, grid, ends);
  return mesh;
}

HexahedralMesh cooks_membrane(double unit_m, double thickness_m, const std::array<std::size_t, 3>& elements) {
  HexahedralMesh mesh = box({1.0, 1.0, thickness_m}, elements);
  move_points(mesh, [&](const Point& at) {
    const double bottom = 44.0 * at[0];
    const double top = 44.0 + 16.0 * at[0];
    return Point{48.0 * unit_m * at[0], unit_m * (bottom + (top - bottom) * at[1]), at[2]};
  });
  return mesh;
}

HexahedralMesh thick_sphere_octant(double inner_radius_m, double outer_radius_m, std::size_t radial, std::size_t tangential) {
  assert(inner_radius_m > 0.0 && tangential >= 1);
  return SphereOctant(inner_radius_m, outer_radius_m, radial, tangential).build();
}

HexahedralMesh thick_cylinder_quarter(double inner_radius_m, double outer_radius_m, double length_m,
                                      const std::array<std::size_t, 3>& elements) {
  assert(0.0 < inner_radius_m && inner_radius_m < outer_radius_m);
  HexahedralMesh mesh = box({1.0, 1.0, length_m}, elements);
  mesh.label_names = {"chamber 0", "outer", "symmetry y", "symmetry x", "symmetry z", "end"};
  move_points(mesh, [&](const Point& at) {
    const double radius = at[0] == 1.0 ? outer_radius_m : inner_radius_m + (outer_radius_m - inner_radius_m) * at[0];
    const double angle = 0.5 * std::numbers::pi * at[1];
    // The cosine of the rounded right angle is not exactly 0, but points must lie in the plane of symmetry.
    return Point{at[1] == 1.0 ? 0.0 : radius * std::cos(angle), radius * std::sin(angle), at[2]};
  });
  mesh.geometry = Geometry::cylindrical;
  add_chamber(mesh, 0);
  mesh.chambers[0].caps.push_back(end_cap(mesh, 5, inner_radius_m));
  return mesh;
}

HexahedralMesh hollow_cube_quarter(double edge_m, double wall_m, std::size_t elements_through_wall) {
  const double half = 0.5 * edge_m - wall_m;
  assert(half > 0.0 && wall_m > 0.0 && elements_through_wall >= 1);
  const double element_edge = wall_m / static_cast<double>(elements_through_wall);
  const auto across_half = static_cast<std::size_t>(std::ceil(half / element_edge - 1e-9));
  MeshGrid grid;
  GridLines from_middle = equal_lines(0.0, half, across_half);
  append(from_middle, equal_lines(half, 0.5 * edge_m, elements_through_wall));
  grid.lines = {from_middle, from_middle, equal_lines(0.0, wall_m, elements_through_wall)};
  append(grid.lines[2], equal_lines(wall_m, edge_m - wall_m, 2 * across_half));
  append(grid.lines[2], equal_lines(edge_m - wall_m, edge_m, elements_through_wall));

  constexpr std::size_t symmetry_x = 0, symmetry_y = 1, ground = 2, outer = 3, chamber = 4;
  for (std::size_t z = 0; z < grid.size()[2]; ++z) {
    for (std::size_t y = 0; y < grid.size()[1]; ++y) {
      for (std::size_t x = 0; x < grid.size()[0]; ++x) {
        const bool inside =
            x < across_half && y < across_half && z >= elements_through_wall && z < elements_through_wall + 2 * across_half;
        grid.contents.push_back(inside ? GridContent::air(chamber) : GridContent::solid(0));
      }
    }
  }
  HexahedralMesh mesh;
  mesh.region_names = {"wall"};
  mesh.label_names = {"symmetry x", "symmetry y", "ground", "outer", "chamber 0"};
  fill_from_grid(mesh, grid, {symmetry_x, outer, symmetry_y, outer, ground, outer});
  add_chamber(mesh, chamber);
  return mesh;
}

}  // namespace menger::meshes
