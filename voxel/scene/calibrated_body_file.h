#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/text/toml_document.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Reads the table `[surrogate]` of a scene or study, if there is one, into physics.surrogate; see read_physics for its keys.
/// What the parameters decide then keeps no value of its own in `physics`, so that equal physics compare equal.
/// @throws io::InputError with file, key and value; also for keys of other tables that contradict it, and for parameters of
/// another silicone or wall thickness than the table says
void read_calibrated_body(const io::TomlTable& table, Physics& physics);

/// The file that `[surrogate]` takes its parameters from, if it names one. @throws io::InputError as read_calibrated_body does
std::optional<std::filesystem::path> parameters_file(const io::TomlTable& table);

/// The table as read_calibrated_body reads it, with the parameters in it.
std::string calibrated_body_text(const CalibratedBody& body);

}  // namespace menger::voxel
