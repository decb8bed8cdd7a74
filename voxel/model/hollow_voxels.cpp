#include "voxel/model/hollow_voxels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "meshes/design/modular_body.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {
namespace {

using meshes::CellIndex;
using meshes::WallZone;

constexpr std::array zones{WallZone::low_outer, WallZone::low_inner, WallZone::middle, WallZone::high_inner,
                           WallZone::high_outer};

/// The part of a zone of a cell that lies in a voxel, along one axis.
struct Slice {
  double length = 0.0;         ///< m
  double second_moment = 0.0;  ///< of the length about the middle of the voxel, m^3
};

/// Slices by the position of the voxel in its cell, then by zone.
using Slices = std::vector<std::array<Slice, zones.size()>>;

Slices slices(const HollowOptions& options) {
  const double edge = options.cell_edge_m;
  const double wall = options.wall_thickness_m;
  const std::array<double, zones.size() + 1> cuts{0.0, 0.5 * wall, wall, edge - wall, edge - 0.5 * wall, edge};
  const double voxel_edge = edge / options.voxels_per_cell;
  Slices result(static_cast<std::size_t>(options.voxels_per_cell));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double low = static_cast<double>(i) * voxel_edge;
    const double middle = low + 0.5 * voxel_edge;
    for (std::size_t zone = 0; zone < zones.size(); ++zone) {
      const double from = std::max(cuts[zone], low) - middle;
      const double to = std::min(cuts[zone + 1], low + voxel_edge) - middle;
      if (to > from) result[i][zone] = {to - from, (to * to * to - from * from * from) / 3.0};
    }
  }
  return result;
}

/// Volume of the wall in a voxel and its second moment, the integral of r^2 about the middle of the voxel.
struct WallShape {
  double volume = 0.0;         ///< m^3
  double second_moment = 0.0;  ///< m^5
};

WallShape wall_shape(const meshes::ModularBody& body, const CellIndex& cell, const std::array<Slice, zones.size()>& along_x,
                     const std::array<Slice, zones.size()>& along_y, const std::array<Slice, zones.size()>& along_z) {
  WallShape wall;
  for (std::size_t k = 0; k < zones.size(); ++k) {
    for (std::size_t j = 0; j < zones.size(); ++j) {
      for (std::size_t i = 0; i < zones.size(); ++i) {
        const Slice x = along_x[i];
        const Slice y = along_y[j];
        const Slice z = along_z[k];
        const double volume = x.length * y.length * z.length;
        if (volume == 0.0 || !body.is_wall(cell, {zones[i], zones[j], zones[k]})) continue;
        wall.volume += volume;
        wall.second_moment +=
            x.second_moment * y.length * z.length + x.length * y.second_moment * z.length + x.length * y.length * z.second_moment;
      }
    }
  }
  return wall;
}

meshes::Polycube split_cells(const meshes::Polycube& cells, int parts) {
  meshes::Polycube voxels(cells.nx() * parts, cells.ny() * parts, cells.nz() * parts);
  for (int z = 0; z < voxels.nz(); ++z) {
    for (int y = 0; y < voxels.ny(); ++y) {
      for (int x = 0; x < voxels.nx(); ++x) voxels.set({x, y, z}, cells.at({x / parts, y / parts, z / parts}));
    }
  }
  return voxels;
}

/// Returns the walled sides of a voxel: those that lie on a side of its cell behind which there is another chamber or no cell.
std::array<bool, 6> walled_sides(const meshes::ModularBody& body, const CellIndex& cell, const std::array<int, 3>& part,
                                 int parts) {
  std::array<bool, 6> walled{};
  for (const meshes::Side side : meshes::all_sides) {
    const int end = meshes::is_max(side) ? parts - 1 : 0;
    const bool on_side = part[meshes::axis_of(side)] == end;
    walled[static_cast<std::size_t>(side)] = on_side && body.region_of(meshes::neighbour(cell, side)) != body.region_of(cell);
  }
  return walled;
}

/// Returns which of the walled sides have a cell of the same module behind them.
std::array<bool, 6> shared_sides(const meshes::ModularBody& body, const CellIndex& cell, const std::array<bool, 6>& walled) {
  std::array<bool, 6> shared{};
  for (const meshes::Side side : meshes::all_sides) {
    const auto at = static_cast<std::size_t>(side);
    shared[at] = walled[at] && body.same_module(cell, meshes::neighbour(cell, side));
  }
  return shared;
}

/// Returns the bulge class of the faces of a voxel across an axis, from the squares of four voxels that it shares with open
/// neighbours.
/// @param walled_across whether each of the four sides parallel to the axis has a wall, in turn
/// @param square whether the whole square between one side and the next is open; the last square lies between the last side and
/// the first
std::uint8_t plate_class(const std::array<bool, 4>& walled_across, const std::array<bool, 4>& square) {
  constexpr std::array<std::uint8_t, 5> by_squares{walls::bend, walls::corner, walls::one, walls::none, walls::none};
  const auto squares = static_cast<std::size_t>(std::ranges::count(square, true));
  const auto arms = std::ranges::count(walled_across, false);
  if (squares > 0 || arms > 2) return by_squares.at(squares);
  if (arms == 2) return walled_across[0] == walled_across[2] ? walls::limb : walls::bend;
  return arms == 1 ? walls::three : walls::closed;
}

/// The wall class of a voxel along an axis, from the sides that carry a wall, and the bulge class of its faces across the axis.
struct AxisClasses {
  std::uint8_t wall;
  std::uint8_t bulge;
};

/// Returns the classes of a voxel along an axis.
/// @param is_open whether another voxel of the grid belongs to the same chamber
template <class IsOpen>
AxisClasses classes_along(std::size_t axis, const CellIndex& voxel, const std::array<bool, 6>& walled, const IsOpen& is_open) {
  const std::size_t first = (axis + 1) % 3;
  const std::size_t second = (axis + 2) % 3;
  const std::array<std::size_t, 4> around{2 * first, 2 * second, 2 * first + 1, 2 * second + 1};
  std::array<bool, 4> across{};
  std::array<bool, 4> square{};
  for (std::size_t n = 0; n < around.size(); ++n) {
    const std::size_t side = around[n];
    const std::size_t next = around[(n + 1) % around.size()];
    across[n] = walled[side];
    square[n] = !walled[side] && !walled[next] &&
                is_open(meshes::neighbour(meshes::neighbour(voxel, meshes::all_sides.at(side)), meshes::all_sides.at(next)));
  }
  constexpr std::array<std::uint8_t, 5> by_count{walls::none, walls::one, walls::limb, walls::three, walls::closed};
  const auto count = static_cast<std::size_t>(std::ranges::count(across, true));
  const std::uint8_t plate = plate_class(across, square);
  const bool adjacent = count == 2 && across[0] != across[2];
  return {.wall = adjacent ? plate : by_count.at(count), .bulge = plate};
}

/// Returns the size class of a voxel along an axis, see inside_plate and plate_edge.
/// @param is_open whether another voxel of the grid belongs to the same chamber
/// @param lies_between whether another voxel of the same chamber has walls on both sides along an axis
template <class IsOpen, class LiesBetween>
std::uint8_t size_class_along(std::size_t axis, std::uint8_t wall_class, const CellIndex& voxel,
                              const std::array<bool, 6>& walled, const IsOpen& is_open, const LiesBetween& lies_between) {
  if (wall_class != walls::limb && wall_class != walls::three) return wall_class;
  const bool first_is_normal = walled[2 * ((axis + 1) % 3)] && walled[2 * ((axis + 1) % 3) + 1];
  const std::size_t normal = (axis + (first_is_normal ? 1 : 2)) % 3;
  const std::size_t across = 3 - axis - normal;
  const auto beside = [&](std::size_t side) { return meshes::neighbour(voxel, meshes::all_sides.at(side)); };
  const auto has_square = [&](std::size_t side) {
    for (const std::size_t along : {2 * axis, 2 * axis + 1}) {
      if (!walled[along] && is_open(meshes::neighbour(beside(side), meshes::all_sides.at(along)))) return true;
    }
    return false;
  };
  bool is_supported = true;  // by limbs that leave the plate on both sides
  for (const std::size_t side : {2 * across, 2 * across + 1}) {
    if (walled[side]) continue;
    if (!has_square(side)) return wall_class;
    is_supported = is_supported && !lies_between(beside(side), normal);
  }
  if (is_supported) return wall_class;
  return wall_class == walls::limb ? inside_plate : plate_edge;
}

/// Returns the law class of the faces of a voxel from its bulge class and the size classes along the two axes of its faces.
std::uint8_t face_class(std::uint8_t bulge_class, std::size_t first, std::size_t second) {
  if (bulge_class == walls::none && first == inside_plate && second == inside_plate) return middle_of_plate;
  if (bulge_class == walls::one && (first == inside_plate || second == inside_plate)) return side_of_plate;
  if (bulge_class == walls::corner && first == plate_edge && second == plate_edge) return corner_of_plate;
  return bulge_class;
}

void check(const HollowOptions& options) {
  if (!(options.wall_thickness_m > 0.0 && 2.0 * options.wall_thickness_m < options.cell_edge_m))
    throw std::invalid_argument("a wall must be thinner than half a cell, and thicker than nothing");
  if (options.voxels_per_cell < 1) throw std::invalid_argument("a cell has at least one voxel along an edge");
}

}  // namespace

HollowVoxels hollow_voxels(const meshes::Polycube& basal_body, const HollowOptions& options) {
  check(options);
  const meshes::ModularBody body(basal_body, options.level, options.chambers);
  const int parts = options.voxels_per_cell;
  const Slices slice = slices(options);
  const double voxel_edge = options.cell_edge_m / parts;
  HollowVoxels voxels;
  voxels.body = split_cells(body.cells(), parts);
  voxels.chamber_count = body.regions().size();
  for (const CellIndex& voxel : voxels.body.occupied()) {
    const CellIndex cell{voxel.x / parts, voxel.y / parts, voxel.z / parts};
    const std::array<int, 3> part{voxel.x % parts, voxel.y % parts, voxel.z % parts};
    voxels.walled.push_back(walled_sides(body, cell, part, parts));
    voxels.shared.push_back(shared_sides(body, cell, voxels.walled.back()));
    const auto is_open = [&](const CellIndex& other) {
      return body.region_of({other.x / parts, other.y / parts, other.z / parts}) == body.region_of(cell);
    };
    const auto lies_between = [&](const CellIndex& other, std::size_t normal) {
      const CellIndex other_cell{other.x / parts, other.y / parts, other.z / parts};
      const std::array<bool, 6> walled =
          walled_sides(body, other_cell, {other.x % parts, other.y % parts, other.z % parts}, parts);
      return walled[2 * normal] && walled[2 * normal + 1];
    };
    std::array<std::uint8_t, 3> wall_class{};
    std::array<std::uint8_t, 3> bulge_class{};
    std::array<std::uint8_t, 3> size_class{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const AxisClasses classes = classes_along(axis, voxel, voxels.walled.back(), is_open);
      wall_class[axis] = classes.wall;
      bulge_class[axis] = classes.bulge;
      size_class[axis] = size_class_along(axis, classes.wall, voxel, voxels.walled.back(), is_open, lies_between);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      bulge_class[axis] = face_class(bulge_class[axis], size_class[(axis + 1) % 3], size_class[(axis + 2) % 3]);
    voxels.wall_class.push_back(wall_class);
    voxels.bulge_class.push_back(bulge_class);
    voxels.size_class.push_back(size_class);
    voxels.chamber.push_back(body.region_of(cell).value());
    const WallShape wall = wall_shape(body, cell, slice[static_cast<std::size_t>(part[0])],
                                      slice[static_cast<std::size_t>(part[1])], slice[static_cast<std::size_t>(part[2])]);
    voxels.wall_volume_m3.push_back(wall.volume);
    // The integral of r^2 over a solid cube is volume L^2 / 4.
    voxels.inertia_factor.push_back(wall.volume > 0.0 ? 4.0 * wall.second_moment / (wall.volume * voxel_edge * voxel_edge) : 1.0);
  }
  return voxels;
}

std::vector<double> voxel_masses(const HollowVoxels& voxels, double density_kg_m3, double smallest_share) {
  std::vector<double> masses;
  double total = 0.0;
  for (const double volume : voxels.wall_volume_m3) {
    masses.push_back(volume * density_kg_m3);
    total += masses.back();
  }
  const double smallest = smallest_share * total / static_cast<double>(masses.size());
  // The mass added to light voxels is taken from the others in proportion. That may push more voxels below the bound; each voxel
  // is lifted at most once.
  std::vector<bool> lifted(masses.size(), false);
  for (bool again = true; again;) {
    again = false;
    double above = 0.0;
    double rest = total;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      if (!lifted[i] && masses[i] < smallest) {
        masses[i] = smallest;
        lifted[i] = again = true;
      }
      (lifted[i] ? rest : above) += lifted[i] ? -smallest : masses[i];
    }
    if (!again) break;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      if (!lifted[i]) masses[i] *= rest / above;
    }
  }
  return masses;
}

}  // namespace menger::voxel
