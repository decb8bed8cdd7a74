#pragma once

#include <filesystem>
#include <optional>

namespace menger::evolution {

/// A body that leans more than this has fallen over: what a search takes, too, unless its study has another
/// evaluation.largest_lean_deg.
inline constexpr double largest_lean_deg = 45.0;

/// That a body has fallen over in its walk.
struct Fall {
  double time_s = 0.0;    ///< at the end of the stroke in which it has
  double lean_deg = 0.0;  ///< by which it leans then
};

/// Returns whether a body falls over in its walk, by the frames (frames.pvd) that the walk left; nothing if it does not, or if
/// the frames do not tell.
///
/// As in a search, the upright axis of the body at the end of each stroke is compared with that at the end of the first one: the
/// drive is alike at these times. The frame nearest to each counts. Turning about the vertical is no lean. A body that has fallen
/// within its first stroke is not told.
/// @param folder of the walk: no file outside of it is read
/// @param period_s of a stroke, > 0
/// @throws io::InputError if the frames cannot be read or are damaged
std::optional<Fall> fall_in_walk(const std::filesystem::path& folder, double period_s);

}  // namespace menger::evolution
