#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace menger::evolution {

/// How a long body bends, such as a finger.
struct Bend {
  double sideways_m = 0.0;  ///< how far the middle of its far end moves across the body, seen from the near end
  double along_m = 0.0;     ///< how far along it; below 0 towards the near end
};

/// Returns how a body bends in the last state of an inflation (fields.pvd), or nothing if it has no such states.
///
/// The near end, within one cell of the lowest end of its longest axis, counts as held: its displacement and rotation are taken
/// out, so that it does not matter how the body is held. Sideways is across the longest axis.
/// @param folder of the inflation: no file outside of it is read
/// @param cell_edge_m > 0
/// @throws io::InputError if the fields cannot be read or are damaged
std::optional<Bend> bend_in_inflation(const std::filesystem::path& folder, double cell_edge_m);

/// The bend of one body in both models.
struct ComparedBend {
  Bend elements;
  Bend voxels;
};

/// Returns how a body bends in both models in a state of a validation (worst.pvd), measured as that of an inflation; nothing if
/// both are not there.
/// @param folder of the validation: no file outside of it is read
/// @param row of the curve of the state, from 0 @param cell_edge_m > 0
/// @throws io::InputError if the fields cannot be read or are damaged
std::optional<ComparedBend> bend_in_validation(const std::filesystem::path& folder, std::size_t row, double cell_edge_m);

}  // namespace menger::evolution
