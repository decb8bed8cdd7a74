#pragma once

#include <atomic>
#include <filesystem>

#include "evolution/reference/reevaluation_locomotion.h"
#include "fem/locomotion/locomotion_result.h"

namespace menger::evolution {

/// Lets the body of a job walk in this process, and keeps in a folder what it takes to resume a walk that was stopped: a
/// checkpoint every twenty seconds and when it is stopped. A checkpoint that is damaged, or was made by another version or
/// instruction set, is left aside. The frames of a study are not written. Thread-safe for different folders.
/// @param folder empty: nothing is kept
/// @param stop as for fem::walk
/// @throws io::InputError for a study that cannot walk, and if the folder cannot be written
fem::LocomotionResult kept_walk(const LocomotionJob& job, const std::filesystem::path& folder, const std::atomic<bool>& stop);

}  // namespace menger::evolution
