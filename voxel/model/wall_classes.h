#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace menger::voxel {

/// The wall class of a voxel along an axis: which of its four sides parallel to the axis carry a wall. The stiffness of its half
/// beams along the axis follows from it, and their lengths outside plates (LawClass).
///
/// Two walls make three classes. Two walls that face each other are a limb of a body (`limb`). Two walls side by side are the
/// corner of a wide body (`corner`) if the voxel diagonally between the two open sides belongs to the same chamber. Otherwise
/// they are the bend of a limb (`bend`), whose faces span no further than those of a limb. Where a cell has several voxels along
/// an edge, this diagonal voxel is part of the same cell, so that no voxel is a `bend`.
///
/// The faces of a voxel across the axis have a class of their own, the bulge class. How far a face bulges depends on how wide its
/// plate is: on the number of squares of four voxels that its voxel forms with open neighbours. An arm, which leads away one
/// voxel wide, makes no square. So the bulge class is that of a voxel with as many squares in a wide plate without arms:
/// `none` for four or three squares, `one` for two, `corner` for one. Without a square it is the wall class. The exception is a
/// voxel without a square where three or four arms meet: it is `bend`, the nearest class that any load case contains.
namespace walls {
enum WallClass : std::uint8_t { none, one, corner, bend, limb, three, closed };
}
inline constexpr std::size_t wall_class_count = 7;
inline constexpr std::size_t closed_wall_class = walls::closed;  ///< walls on all four sides
/// The names of the classes in files, by position: walls on none, one, two adjacent (corner, bend), two opposite, three and four
/// sides.
inline constexpr std::array<std::string_view, wall_class_count> wall_class_names{"0", "1", "2a", "2b", "2o", "3", "4"};
inline constexpr std::array<std::string_view, wall_class_count> wall_class_meanings{
    "no wall beside them",
    "a wall on one side",
    "walls on two sides that meet, in a wide body",
    "walls on two sides that meet, at the bend of a limb",
    "walls on two opposite sides",
    "walls on three sides",
    "walls on all four sides"};
/// Returns a class as messages name it: "voxels with a wall on one side (wall class 1)".
inline std::string wall_class_text(std::size_t wall_class) {
  return "voxels with " + std::string(wall_class_meanings.at(wall_class)) + " (wall class " +
         std::string(wall_class_names.at(wall_class)) + ")";
}
template <class Value>
using ByWallClass = std::array<Value, wall_class_count>;

/// Which law a half of a voxel along an axis, or a face, follows: that of its wall class, or bulge class, but in plates. The
/// walls of a plate become arcs. So its edges are drawn in, and its faces rise further than those of a block.
///
/// Halves: `inside_plate` is walls::limb with an open square of four voxels on both sides of the half, `beside_arm` with one on
/// one side only, as where an arm leaves the plate or the plate has a notch. `plate_edge` is walls::three with a square on its
/// open side, `inner_edge` is walls::bend with squares on both, where two plates meet. Where limbs leave the plate in all these
/// squares beside the voxel, they hold it, and the half has its wall class. A plate that does not end there, but goes on round an
/// edge, does not hold it.
///
/// Faces, across each axis of a voxel: `middle_of_plate` if both axes along the face have halves in the plate, `side_of_plate` if
/// the axis does along which the plate goes on to both sides (so also where two squares meet at a corner), `corner_of_plate` if
/// both axes do. Faces of squares beside an edge round which a plate goes on are in it, too. An arm, which leaves the plate one
/// voxel wide, lets the face beside it rise further.
enum LawClass : std::uint8_t {
  inside_plate = wall_class_count,
  plate_edge,
  beside_arm,
  inner_edge,
  middle_of_plate,
  side_of_plate,
  side_with_arm,
  corner_of_plate,
  corner_with_arm,
  corner_with_two_arms
};
inline constexpr std::size_t law_class_count = corner_with_two_arms + 1;

/// Where in a plate the halves or faces of a law class are, and so how their law differs from that of their wall class, see
/// SurrogateParameters::extension_of and bulge_of.
struct PlaceInPlate {
  std::size_t wall_class;  ///< whose law it begins with
  bool is_face;            ///< false: a half along an axis
  /// The power of SurrogateParameters::plate_edge_share in the law: 0 away from the edges of a plate; 1 for halves at its edge or
  /// beside an arm or a notch, and for faces in its corners; 1/2 for faces at its sides.
  double edge_power;
  int arms;                  ///< that lead away beside the face
  std::string_view meaning;  ///< as messages say it, after "voxels"
};
/// By position in LawClass.
inline constexpr std::array<PlaceInPlate, law_class_count - wall_class_count> places_in_plates{{
    {walls::limb, false, 0.0, 0, "inside a plate"},
    {walls::three, false, 1.0, 0, "at the edge of a plate"},
    {walls::limb, false, 1.0, 0, "in a plate beside an arm or a notch"},
    {walls::bend, false, 0.0, 0, "at the inner edge of two plates"},
    {walls::none, true, 0.0, 0, "in the middle of a plate"},
    {walls::one, true, 0.5, 0, "at the side of a plate"},
    {walls::one, true, 0.5, 1, "at the side of a plate with an arm"},
    {walls::corner, true, 1.0, 0, "in the corner of a plate"},
    {walls::corner, true, 1.0, 1, "in the corner of a plate with an arm"},
    {walls::corner, true, 1.0, 2, "in the corner of a plate with two arms"},
}};
static_assert(!places_in_plates.back().meaning.empty(), "a row for each law class");

constexpr bool is_in_plate(std::size_t law_class) { return law_class >= wall_class_count; }
/// Only where is_in_plate(law_class).
constexpr const PlaceInPlate& place_in_plate(std::size_t law_class) { return places_in_plates.at(law_class - wall_class_count); }
/// Returns the wall class of a law class.
constexpr std::size_t wall_class_of(std::size_t law_class) {
  return is_in_plate(law_class) ? place_in_plate(law_class).wall_class : law_class;
}
/// Returns a law class as messages name it.
inline std::string law_class_text(std::size_t law_class) {
  return is_in_plate(law_class) ? "voxels " + std::string(place_in_plate(law_class).meaning) : wall_class_text(law_class);
}
template <class Value>
using ByLawClass = std::array<Value, law_class_count>;

/// The number of cells between two walls that face each other: one, two, or three and more.
namespace gaps {
enum Gap : std::uint8_t { one_cell, two_cells, three_or_more_cells };
}
inline constexpr std::size_t gap_count = 3;
template <class Value>
using ByGap = std::array<Value, gap_count>;

/// Returns the same value for every class.
constexpr ByWallClass<double> all_classes(double value) {
  ByWallClass<double> values{};
  values.fill(value);
  return values;
}

}  // namespace menger::voxel
