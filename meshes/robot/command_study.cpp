#include "meshes/robot/command_study.h"

#include <array>

#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "meshes/robot/robot_file.h"

namespace menger::meshes {

namespace fs = std::filesystem;

void take_champion(Robot& robot, const RobotPlaces& places) {
  if (!robot.evolves || !io::is_file(places.champion())) return;
  robot.design.body = read_design(places.champion()).body;
}

CommandStudy command_study(const fs::path& given, RobotStudy study) {
  if (!is_robot_file(given)) return {given, given.stem()};
  Robot robot = read_robot(given);
  const RobotPlaces places(given);
  if (const std::string reason = missing_because(robot, study); !reason.empty())
    throw io::InputError(given.string() + ": " + reason);
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
  return {places.study(study), places.folder(study)};
}

void refuse_robot_file(const fs::path& given) {
  if (is_robot_file(given))
    throw io::InputError(given.string() + ": is the file of a robot, not a study of this command (--template prints one): menger loop " + given.string() +
                         " runs all stages that it asks for");
}

}  // namespace menger::meshes
