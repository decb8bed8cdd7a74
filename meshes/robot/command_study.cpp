#include "meshes/robot/command_study.h"

#include <array>
#include <system_error>

#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "meshes/robot/robot_file.h"

namespace menger::meshes {

namespace fs = std::filesystem;

namespace {

/// Refuses a study that needs the results of a fit which has not been made, and says how to make it.
void require_fit(const Robot& robot, RobotStudy study, const RobotPlaces& places) {
  const std::string loop = "menger loop " + robot.file.string();
  if (study == RobotStudy::calibrate && !fs::exists(places.folder(RobotStudy::load_cases))) {
    const bool is_known = parameter_source(robot) == ParameterSource::known;
    throw io::InputError(robot.file.string() + ": " +
                         (is_known ? "menger comes with voxels for these cells; to fit them anew, first " + loop + " --fit"
                                   : "the load cases of these cells have not been computed: first " + loop) +
                         " --until load_cases, or name a folder of curves with --curves");
  }
  const bool needs_voxels = study == RobotStudy::simulate || study == RobotStudy::validate;
  if (!needs_voxels || parameter_source(robot) != ParameterSource::fitted || io::is_file(places.fitted_parameters())) return;
  throw io::InputError(robot.file.string() + ": voxels have not been fitted to these cells: first " + loop +
                       " --until calibrate");
}

}  // namespace

void take_champion(Robot& robot, const RobotPlaces& places) {
  if (!robot.evolves || !io::is_file(places.champion())) return;
  robot.design.body = read_design(places.champion()).body;
}

fs::path robot_file_in(const fs::path& given) {
  std::error_code ignored;
  return fs::is_directory(given, ignored) && io::is_file(given / "robot.toml") ? given / "robot.toml" : given;
}

CommandStudy command_study(const fs::path& named, RobotStudy study, const fs::path& output, bool has_own_fit) {
  const fs::path given = robot_file_in(named);
  if (!is_robot_file(given)) return {given, output.empty() ? given.stem() : output};
  Robot robot = read_robot(given);
  RobotPlaces places(given);
  places.output = output;
  if (const std::string reason = missing_because(robot, study); !reason.empty())
    throw io::InputError(given.string() + ": " + std::string(to_string(study)) + " is not computed for this robot: " + reason);
  if (!has_own_fit) require_fit(robot, study, places);
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

void refuse_robot_file(const fs::path& named) {
  const fs::path given = robot_file_in(named);
  if (is_robot_file(given)) {
    throw io::InputError(given.string() +
                         ": is the file of a robot, not a study of this command (--template prints one): menger loop " +
                         given.string() + " runs all stages that it asks for");
  }
}

}  // namespace menger::meshes
