#include "voxel/model/voxel_classes.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "voxel/model/wall_classes.h"

namespace menger::voxel {
namespace {

using meshes::CellIndex;
using meshes::neighbour;
using meshes::Side;

Side side_at(std::size_t side) { return meshes::all_sides.at(side); }

/// The sides of a voxel parallel to an axis, one after the other around it.
std::array<Side, 4> sides_around(std::size_t axis) {
  const std::size_t first = (axis + 1) % 3;
  const std::size_t second = (axis + 2) % 3;
  return {side_at(2 * first), side_at(2 * second), side_at(2 * first + 1), side_at(2 * second + 1)};
}

/// What lies around a voxel across an axis: which sides are open, and which squares of four voxels, each between one side and the
/// next; the last one lies between the last side and the first.
struct Surroundings {
  std::array<Side, 4> sides;
  std::array<bool, 4> open{};
  std::array<bool, 4> square{};

  Surroundings(const ChamberVoxels& chamber, const CellIndex& voxel, std::size_t axis) : sides(sides_around(axis)) {
    for (std::size_t n = 0; n < sides.size(); ++n) {
      open[n] = chamber.contains(neighbour(voxel, sides[n]));
      square[n] = chamber.has_square(voxel, sides[n], sides[(n + 1) % sides.size()]);
    }
  }
  [[nodiscard]] std::size_t open_count() const { return static_cast<std::size_t>(std::ranges::count(open, true)); }
  [[nodiscard]] std::size_t square_count() const { return static_cast<std::size_t>(std::ranges::count(square, true)); }
  /// Whether two walls, or two open sides, face each other.
  [[nodiscard]] bool faces_itself() const { return open[0] == open[2]; }
  /// The number of arms: open sides beside no square.
  [[nodiscard]] std::size_t arms() const {
    std::size_t arms = 0;
    for (std::size_t n = 0; n < sides.size(); ++n) {
      if (open[n] && !square[n] && !square[(n + 3) % sides.size()]) ++arms;
    }
    return arms;
  }
};

/// Returns the bulge class of the faces of a voxel across an axis.
std::uint8_t bulge_class(const Surroundings& around) {
  constexpr std::array<std::uint8_t, 5> by_squares{walls::bend, walls::corner, walls::one, walls::none, walls::none};
  const std::size_t squares = around.square_count();
  const std::size_t open = around.open_count();
  if (squares > 0 || open > 2) return by_squares.at(squares);
  if (open == 2) return around.faces_itself() ? walls::limb : walls::bend;
  return open == 1 ? walls::three : walls::closed;
}

std::uint8_t wall_class(const Surroundings& around) {
  if (around.open_count() == 2 && !around.faces_itself()) return bulge_class(around);
  constexpr std::array<std::uint8_t, 5> by_open{walls::closed, walls::three, walls::limb, walls::one, walls::none};
  return by_open.at(around.open_count());
}

/// Returns the law class of the half of a voxel on a side where it is open.
std::uint8_t half_class(const ChamberVoxels& chamber, const CellIndex& voxel, Side towards, std::uint8_t wall_class) {
  const std::size_t axis = meshes::axis_of(towards);
  std::size_t squares = 0;
  bool is_held = true;  // by limbs that leave the plate in all squares
  for (const Side side : sides_around(axis)) {
    if (!chamber.has_square(voxel, side, towards)) continue;
    ++squares;
    const CellIndex beside = neighbour(voxel, side);
    const std::size_t normal = 3 - axis - meshes::axis_of(side);
    // A plate that goes on round an edge does not hold this one.
    is_held = is_held && !chamber.is_between_walls(beside, normal) && !chamber.has_square(beside, side_at(2 * normal), towards) &&
              !chamber.has_square(beside, side_at(2 * normal + 1), towards);
  }
  if (wall_class == walls::bend && squares == 2) return inner_edge;
  if (is_held) return wall_class;
  if (wall_class == walls::three) return plate_edge;
  if (wall_class == walls::limb) return squares == 2 ? inside_plate : beside_arm;
  return wall_class;
}

/// Returns the law class of both halves of a voxel along an axis, see VoxelClasses::size.
std::uint8_t class_of_both(std::uint8_t lower, std::uint8_t upper, std::uint8_t wall_class) {
  if (lower == upper) return lower;
  if (!is_in_plate(lower) || !is_in_plate(upper)) return wall_class;
  return beside_arm;  // the other one is inside_plate
}

/// Whether the face of a voxel across an axis belongs to a plate that goes on round an edge beside it: at least half of the
/// voxels of its squares lie between walls, and at the others a plate leads away.
bool is_beside_edge(const ChamberVoxels& chamber, const CellIndex& voxel, std::size_t axis, const Surroundings& around) {
  std::vector<CellIndex> voxels{voxel};
  for (std::size_t n = 0; n < around.sides.size(); ++n) {
    const CellIndex beside = neighbour(voxel, around.sides[n]);
    if (around.square[n] || around.square[(n + 3) % around.sides.size()]) voxels.push_back(beside);
    if (around.square[n]) voxels.push_back(neighbour(beside, around.sides[(n + 1) % around.sides.size()]));
  }
  const auto is_between = [&](const CellIndex& other) { return chamber.is_between_walls(other, axis); };
  const auto leads_away = [&](const CellIndex& other) {
    return std::ranges::any_of(around.sides, [&](Side side) {
      return chamber.has_square(other, side_at(2 * axis), side) || chamber.has_square(other, side_at(2 * axis + 1), side);
    });
  };
  return 2 * std::ranges::count_if(voxels, is_between) >= std::ssize(voxels) &&
         std::ranges::all_of(voxels, [&](const CellIndex& other) { return is_between(other) || leads_away(other); });
}

/// Returns the law class of the faces of a voxel across an axis.
/// @param classes of its walls and halves
std::uint8_t face_class(const ChamberVoxels& chamber, const CellIndex& voxel, std::size_t axis, const Surroundings& around,
                        const VoxelClasses& classes) {
  const std::uint8_t bulge = bulge_class(around);
  if (around.square_count() == 0) return bulge;
  const std::array<std::size_t, 2> along{(axis + 1) % 3, (axis + 2) % 3};
  const auto ends_in_plate = [&](std::size_t a) {
    return is_in_plate(classes.half[2 * a]) || is_in_plate(classes.half[2 * a + 1]);
  };
  const auto spans = [&](std::size_t a) { return ends_in_plate(a) && classes.wall[a] == walls::limb; };
  const bool is_wide = is_beside_edge(chamber, voxel, axis, around);
  const bool in_both = is_wide || std::ranges::all_of(along, ends_in_plate);
  if (bulge == walls::none && in_both) return middle_of_plate;
  if (bulge == walls::one && (is_wide || std::ranges::any_of(along, spans)))
    return around.arms() == 0 ? side_of_plate : side_with_arm;
  constexpr std::array<std::uint8_t, 3> corners{corner_of_plate, corner_with_arm, corner_with_two_arms};
  if (bulge == walls::corner && in_both) return corners.at(around.arms());
  return bulge;
}

}  // namespace

ChamberVoxels::ChamberVoxels(const meshes::ModularBody& body, const CellIndex& cell, int parts)
    : body_(&body), region_(body.region_of(cell).value()), parts_(parts) {}

bool ChamberVoxels::contains(const CellIndex& voxel) const {
  if (std::min({voxel.x, voxel.y, voxel.z}) < 0) return false;
  return body_->region_of({voxel.x / parts_, voxel.y / parts_, voxel.z / parts_}) == region_;
}

bool ChamberVoxels::has_square(const CellIndex& voxel, Side first, Side second) const {
  const CellIndex beside = neighbour(voxel, first);
  return contains(beside) && contains(neighbour(voxel, second)) && contains(neighbour(beside, second));
}

bool ChamberVoxels::is_between_walls(const CellIndex& voxel, std::size_t axis) const {
  return !contains(neighbour(voxel, side_at(2 * axis))) && !contains(neighbour(voxel, side_at(2 * axis + 1)));
}

VoxelClasses classes_of_voxel(const ChamberVoxels& chamber, const CellIndex& voxel) {
  const std::array<Surroundings, 3> around{Surroundings(chamber, voxel, 0), Surroundings(chamber, voxel, 1),
                                           Surroundings(chamber, voxel, 2)};
  VoxelClasses classes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint8_t wall = wall_class(around[axis]);
    std::array<bool, 2> open{};
    std::array<std::uint8_t, 2> halves{wall, wall};
    for (std::size_t end = 0; end < open.size(); ++end) {
      const Side side = side_at(2 * axis + end);
      open[end] = chamber.contains(neighbour(voxel, side));
      if (open[end]) halves[end] = half_class(chamber, voxel, side, wall);
    }
    // Up to a wall a voxel lengthens as on its other side.
    if (open[0] && !open[1]) halves[1] = halves[0];
    if (open[1] && !open[0]) halves[0] = halves[1];
    classes.wall[axis] = wall;
    classes.half[2 * axis] = halves[0];
    classes.half[2 * axis + 1] = halves[1];
    classes.size[axis] = class_of_both(halves[0], halves[1], wall);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) classes.bulge[axis] = face_class(chamber, voxel, axis, around[axis], classes);
  return classes;
}

}  // namespace menger::voxel
