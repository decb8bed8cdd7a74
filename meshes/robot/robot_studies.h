#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "meshes/robot/robot.h"

namespace menger::meshes {

/// The studies that follow from a robot. Each is a file of its own, which a command reads.
enum class RobotStudy {
  mesh,                 ///< of `menger mesh`
  inflate,              ///< of `menger inflate`: up to the highest pressure of the drive
  limit,                ///< of `menger inflate`: up to the largest pressure that the body bears
  load_cases,           ///< of `menger load-cases`: what the voxels are fitted to
  calibrate,            ///< of `menger calibrate`
  validate_load_cases,  ///< of `menger load-cases`: the robot itself, inflated
  validate,             ///< of `menger validate`
  simulate,             ///< of `menger simulate`
  locomote,             ///< of `menger locomote`
  locomote_finer,       ///< of `menger locomote`, on the next finer elements
  evolve,               ///< of `menger evolve`
  reevaluate            ///< of `menger reevaluate`
};

/// The word for a study: the name of its file without .toml, and that of the folder of its results.
std::string_view to_string(RobotStudy study);

/// All studies, in the order in which they can be run.
std::span<const RobotStudy> robot_studies();

/// Whether a study needs the body, and not only what it is made of.
bool needs_body(RobotStudy study);

/// Returns why a robot has no such study: "walk.present = false"; empty if it has one.
std::string missing_because(const Robot& robot, RobotStudy study);

/// The number of states, at equal distances up to the strongest pressure of the drive, in which the stage validate compares both
/// models.
inline constexpr int validated_states = 6;

/// Where a robot's studies and results lie.
struct RobotPlaces {
  /// @param robot_file robot.toml
  /// @param results_folder folder of all results; empty: "results" beside the robot
  explicit RobotPlaces(const std::filesystem::path& robot_file, const std::filesystem::path& results_folder = {});

  std::filesystem::path results;
  std::filesystem::path output{};  ///< folder of one command, which takes its studies and curves; empty: each has its own below

  [[nodiscard]] std::filesystem::path studies() const { return (output.empty() ? results : output) / "studies"; }
  [[nodiscard]] std::filesystem::path study(RobotStudy study) const;
  /// Folder of the results of a study.
  [[nodiscard]] std::filesystem::path folder(RobotStudy study) const;
  /// The design of the best robot of the search.
  [[nodiscard]] std::filesystem::path champion() const { return results / "export" / "champion.toml"; }
  /// Voxel parameters that were fitted for the robot.
  [[nodiscard]] std::filesystem::path fitted_parameters() const { return folder(RobotStudy::calibrate) / "parameters.toml"; }
};

/// Where the voxel parameters of a robot come from.
enum class ParameterSource { given, known, fitted };

/// Returns the file of a robot's voxel parameters: the given one, that which comes with menger, or that which is fitted.
std::filesystem::path parameters_of(const Robot& robot, const RobotPlaces& places);
ParameterSource parameter_source(const Robot& robot);

/// Returns the text of a study. Precondition: missing_because() is empty, and there is a body if needs_body().
/// @param places relative paths in the text count from its studies()
std::string study_text(const Robot& robot, RobotStudy study, const RobotPlaces& places);

/// Writes the texts of studies, each whole, where they are not there already. @throws io::InputError
void write_studies(const Robot& robot, std::span<const RobotStudy> studies, const RobotPlaces& places);

}  // namespace menger::meshes
