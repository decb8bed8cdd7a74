#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fem/locomotion/locomotion_dynamics.h"
#include "fem/locomotion/locomotion_result.h"

namespace menger::fem {

/// The progress of a run that is under way or has ended.
struct LocomotionProgress {
  LocomotionState state;  ///< the state from which it can be resumed
  std::vector<LocomotionRecord> records{};
  std::optional<LocomotionOutcome> outcome{};  ///< how it ended; empty while it is under way
  double seconds = 0.0;                        ///< wall time so far
};

/// Writes a checkpoint, whole or not at all.
/// @param identity everything that the run depends on; reading requires the same
/// @throws io::InputError if the file cannot be written
void write_locomotion_checkpoint(const std::filesystem::path& file, const std::string& identity,
                                 const LocomotionProgress& progress);

/// Reads a checkpoint. Empty if there is no such file. Numbers are restored exactly.
/// @throws io::InputError if it is damaged or has another identity
std::optional<LocomotionProgress> read_locomotion_checkpoint(const std::filesystem::path& file, const std::string& identity);

}  // namespace menger::fem
