#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/robot/robot_studies.h"

namespace menger::evolution {

/// One stage of a loop: a run of another program of menger.
///
/// The program runs in the folder of the results, so that all paths are short and count from there.
struct LoopStage {
  std::string name;     ///< "inflate"; also that of its folder and its log
  std::string program;  ///< "menger-inflate"
  std::vector<std::string> arguments{};
  /// Studies that are written before it runs. Their texts are part of what decides its results.
  std::vector<meshes::RobotStudy> studies{};
  std::vector<std::string> needs{};            ///< stages without whose results it cannot run
  std::vector<std::string> helpers{};          ///< other programs that it starts, which decide its results, too
  std::vector<std::filesystem::path> reads{};  ///< files whose content decides its results; relative ones count from the results
  /// Stages whose identity decides its results, in place of files that are written to again, such as archives.
  std::vector<std::string> follows{};
  std::filesystem::path manifest{};  ///< what it writes last, counted from the results
  bool needs_body = false;           ///< whether it needs the body that a search may find
  bool is_driven = false;            ///< whether it takes the body through the pressures of its drive
  bool may_restart = false;          ///< whether the program takes --restart, and refuses a folder of another study without it
  bool begins_anew = false;          ///< whether the program keeps nothing of a run that was stopped
  bool is_set_aside = false;         ///< whether its earlier folder is kept elsewhere when another study takes its place
  bool is_usable_early = false;      ///< whether other stages can use results that ended with a numerical outcome
  double expected_s = 1.0;           ///< rough wall time on an idle core
};

/// Returns the stages that a robot asks for, in the order in which they run. With a search that needs no voxels, its stages come
/// first if the body is that of the search.
/// @param has_report whether the program menger-report is there
std::vector<LoopStage> loop_stages(const meshes::Robot& robot, const meshes::RobotPlaces& places, bool has_report);

/// Returns what a stage writes last, counted from the results.
std::filesystem::path manifest_of(const std::string& stage);

/// Returns the stage of a name. @throws io::InputError naming the option and the stages of this robot
const LoopStage& stage_named(const std::vector<LoopStage>& stages, std::string_view option, const std::string& name);

}  // namespace menger::evolution
