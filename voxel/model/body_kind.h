#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "meshes/design/polycube.h"

namespace menger::voxel {

/// The kind of a body, by which the errors of calibrated voxels differ: how its cells form plates, that is, squares of four cells
/// in one plane, where these meet, and what it stands on. A body is of the first kind that fits.
enum class BodyKind {
  limbs,               ///< no square: single cells, bars, bends, rings, frames
  flat_plate,          ///< a square, and all cells in one layer
  stepped,             ///< an edge that points inwards and is two cells long or longer: a step, an overhang, a wall on a plate
  plate_on_legs,       ///< a square, but none with a cell of the lowest layer
  plate_with_limbs,    ///< stands on a plate, and has a cell that is in no square
  block,               ///< every cell is in a square
  aggregate_of_limbs,  ///< several modules, of limbs each
  aggregate_of_stepped_bodies,  ///< several modules, stepped each
  aggregate_of_plates           ///< several modules, with a square each
};
inline constexpr std::size_t body_kind_count = 9;
template <class Value>
using ByBodyKind = std::array<Value, body_kind_count>;
inline constexpr ByBodyKind<BodyKind> body_kinds{BodyKind::limbs,
                                                 BodyKind::flat_plate,
                                                 BodyKind::stepped,
                                                 BodyKind::plate_on_legs,
                                                 BodyKind::plate_with_limbs,
                                                 BodyKind::block,
                                                 BodyKind::aggregate_of_limbs,
                                                 BodyKind::aggregate_of_stepped_bodies,
                                                 BodyKind::aggregate_of_plates};

/// Whether a kind is one of several modules.
constexpr bool is_aggregate(BodyKind kind) {
  return kind == BodyKind::aggregate_of_limbs || kind == BodyKind::aggregate_of_stepped_bodies ||
         kind == BodyKind::aggregate_of_plates;
}

/// Returns the kind of the fractal of a basal body: the first of BodyKind, single modules before aggregates, that it is.
/// @param level >= 1
BodyKind kind_of(const meshes::Polycube& basal_body, int level);

std::string_view to_string(BodyKind kind);    ///< in tables: "plate_on_legs"
std::string_view name_of(BodyKind kind);      ///< for people, with its article: "a plate on legs"
std::string_view plural_name(BodyKind kind);  ///< for people: "plates on legs"

/// Returns the kind of this name in tables; nothing if there is none.
std::optional<BodyKind> body_kind(std::string_view name);

}  // namespace menger::voxel
