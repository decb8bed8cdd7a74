#include "meshes/robot/command_study.h"

#include <array>

#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "meshes/robot/robot_file.h"

namespace menger::meshes {

namespace fs = std::filesystem;

namespace {

/// The stage whose results a study needs and that has none yet; empty if there is none.
std::string missing_fit(const Robot& robot, RobotStudy study, const RobotPlaces& places) {
  if (study == RobotStudy::calibrate) return fs::exists(places.folder(RobotStudy::load_cases)) ? "" : "load_cases";
  const bool needs_voxels = study == RobotStudy::simulate || study == RobotStudy::validate;
  return !needs_voxels || parameter_source(robot) != ParameterSource::fitted || io::is_file(places.fitted_parameters())
             ? ""
             : "calibrate";
}

}  // namespace

void take_champion(Robot& robot, const RobotPlaces& places) {
  if (!robot.evolves || !io::is_file(places.champion())) return;
  robot.design.body = read_design(places.champion()).body;
}

CommandStudy command_study(const fs::path& given, RobotStudy study, const fs::path& output) {
  if (!is_robot_file(given)) return {given, output.empty() ? given.stem() : output};
  Robot robot = read_robot(given);
  RobotPlaces places(given);
  if (!output.empty()) places.studies_folder = output / "studies";
  if (const std::string reason = missing_because(robot, study); !reason.empty())
    throw io::InputError(given.string() + ": " + std::string(to_string(study)) + " is not computed for this robot: " + reason);
  if (const std::string stage = missing_fit(robot, study, places); !stage.empty())
    throw io::InputError(given.string() +
                         ": menger comes with no voxels for these cells, and they have not been fitted: first menger "
                         "loop " +
                         given.string() + " --until " + stage);
  if (needs_body(study)) take_champion(robot, places);
  if (needs_body(study) && !robot.has_body()) {
    throw io::InputError(given.string() + ": robot.design = \"evolve\": no search has found a body yet: first menger loop " +
                         given.string() + " --until export");
  }
  if (study == RobotStudy::validate) {
    write_studies(robot, std::array{study, RobotStudy::validate_load_cases}, places);
  } else {
    write_studies(robot, std::array{study}, places);
  }
  return {places.study(study), output.empty() ? places.folder(study) : output};
}

void refuse_robot_file(const fs::path& given) {
  if (is_robot_file(given))
    throw io::InputError(given.string() +
                         ": is the file of a robot, not a study of this command (--template prints one): menger loop " +
                         given.string() + " runs all stages that it asks for");
}

}  // namespace menger::meshes
