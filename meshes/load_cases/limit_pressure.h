#pragma once

#include <optional>
#include <string>

#include "io/text/toml_document.h"

namespace menger::meshes {

/// The pressure at which a body balloons or buckles.
struct LimitPressure {
  double pressure_Pa = 0.0;
  std::string plenum{};  ///< empty if it has no name
};

/// Above this share of the limit pressure small faults of a cast wall decide.
inline constexpr double largest_safe_share = 0.8;

/// "20 %": how far below its limit pressure a body is safe
std::string safe_margin_text();

/// By how much limit pressures of thin walls came out higher than those of three-field elements, at least and at most
/// (fem/load_cases/README.md).
inline constexpr double least_thin_wall_excess = 0.01;
inline constexpr double largest_thin_wall_excess = 0.12;

/// "1 to 12 %": those excesses
std::string thin_wall_excess_text();

/// Returns the least that the limit pressure of a body may be, Pa. @param limit_Pa of thin walls
constexpr double least_limit_of_thin_walls_Pa(double limit_Pa) { return limit_Pa / (1.0 + largest_thin_wall_excess); }

/// Returns the least limit pressure above 0 of a body, from the result (result.toml) of its inflation.
///
/// Of each plenum the first limit point counts: on a path that goes on beyond it, the next one is the least pressure after the
/// body has ballooned, which no growing pressure comes to first.
/// @return nothing if there is no limit point above 0
/// @throws io::InputError if a limit point has no pressure
std::optional<LimitPressure> limit_pressure(const io::TomlTable& inflation);

}  // namespace menger::meshes
