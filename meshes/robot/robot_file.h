#pragma once

#include <filesystem>

#include "io/study/study_visitor.h"
#include "meshes/robot/robot.h"

namespace menger::meshes {

/// Describes the keys of robot.toml; `menger loop --keys` lists them.
void describe(io::StudyVisitor& visitor, Robot& robot);

/// Whether a file is a robot: TOML with a table [robot]. The studies of commands have none. A file that is missing or no TOML is
/// no robot; who reads it next says what is wrong.
bool is_robot_file(const std::filesystem::path& file);

/// Reads a robot and the record of its silicone. @throws io::InputError with file, key and value
Robot read_robot(const std::filesystem::path& file);

}  // namespace menger::meshes
