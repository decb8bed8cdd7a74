#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fem/locomotion/locomotion_dynamics.h"
#include "fem/locomotion/locomotion_result.h"

namespace menger::fem {

/// A run that is under way or at its end.
struct LocomotionProgress {
  LocomotionState state;  ///< where it can be taken up
  std::vector<LocomotionRecord> records{};
  std::optional<LocomotionOutcome> outcome{};  ///< how it ended; none while it is under way
  double seconds = 0.0;                        ///< wall time so far
};

/// Writes a checkpoint, whole or not at all. @param identity what the run depends on; reading demands the same
/// @throws io::InputError if the place cannot be written
void write_locomotion_checkpoint(const std::filesystem::path& file, const std::string& identity,
                                 const LocomotionProgress& progress);

/// Reads a checkpoint; nothing if there is no such file. Numbers come back exactly.
/// @throws io::InputError if it is damaged or of another identity
std::optional<LocomotionProgress> read_locomotion_checkpoint(const std::filesystem::path& file, const std::string& identity);

}  // namespace menger::fem
