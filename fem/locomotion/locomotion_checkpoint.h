#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "fem/locomotion/locomotion_study.h"
#include "fem/walk/walk.h"

namespace menger::fem {

/// Returns everything that the progress of a run depends on: the study, the version of menger and the instruction set.
std::string locomotion_identity(const LocomotionStudy& study, const WalkDynamics& dynamics);

/// Writes a checkpoint, whole or not at all.
/// @param identity everything that the run depends on; reading requires the same
/// @throws io::InputError if the file cannot be written
void write_locomotion_checkpoint(const std::filesystem::path& file, const std::string& identity, const WalkProgress& progress);

/// Reads a checkpoint. Empty if there is no such file. Numbers are restored exactly.
/// @throws io::InputError if it is damaged or has another identity
std::optional<WalkProgress> read_locomotion_checkpoint(const std::filesystem::path& file, const std::string& identity);

/// Continues a walk from its checkpoint, if there is one.
/// @return the wall time that it has taken so far, s; empty without a checkpoint
/// @throws io::InputError naming the file as read_locomotion_checkpoint does, and if its content cannot be that of this walk
std::optional<double> resume_from_checkpoint(Walk& walk, const std::filesystem::path& file, const std::string& identity);

}  // namespace menger::fem
