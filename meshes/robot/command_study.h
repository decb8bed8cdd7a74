#pragma once

#include <filesystem>

#include "meshes/robot/robot_studies.h"

namespace menger::meshes {

/// The study that a command reads, and the folder that it writes to if the user names none.
struct CommandStudy {
  std::filesystem::path study;
  std::filesystem::path folder;
};

/// Returns the robot.toml of a folder that has one; anything else as it is.
std::filesystem::path robot_file_in(const std::filesystem::path& given);

/// Returns the study of a command that was given a file, or the folder of a robot. A study is used as it is; its folder has its
/// name. From a robot (is_robot_file) the study is derived and written where `menger loop` has it; so is the folder. If a search
/// finds the body, it is that of the search's champion.
/// @param output the folder that the user names, which takes the studies of a robot, too; empty: none
/// @param has_own_fit whether the user names what a fit would give: the curves of a calibration, the parameters of a validation
/// @throws io::InputError if the robot is wrong, has no such study, has no body yet, or needs a fit that has not been made
CommandStudy command_study(const std::filesystem::path& named, RobotStudy study, const std::filesystem::path& output = {},
                           bool has_own_fit = false);

/// Refuses the file or folder of a robot, for commands that have no study of it.
/// @throws io::InputError if it is that
void refuse_robot_file(const std::filesystem::path& named);

/// Gives a robot whose body a search finds the body that it found; does nothing to others, and nothing if no search has ended.
void take_champion(Robot& robot, const RobotPlaces& places);

}  // namespace menger::meshes
