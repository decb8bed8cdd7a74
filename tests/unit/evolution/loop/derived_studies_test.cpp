// The studies that follow from robots, read by the readers of all commands.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "evolution/reference/reevaluation_study.h"
#include "evolution/study/study_file.h"
#include "fem/inflation/inflation_study_file.h"
#include "fem/load_cases/load_case_study_file.h"
#include "fem/locomotion/locomotion_study_file.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "meshes/design/hollow_body_file.h"
#include "meshes/robot/robot_file.h"
#include "meshes/robot/robot_studies.h"
#include "meshes/robot/starting_points.h"
#include "tests/support/test_folder.h"
#include "voxel/scene/scene_file.h"
#include "voxel/validation/validation_study.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using meshes::RobotStudy;

/// Reads a study as its command does; throws io::InputError.
void read_study(RobotStudy study, const fs::path& file, const fs::path& search) {
  switch (study) {
    case RobotStudy::mesh:
      static_cast<void>(meshes::read_mesh_study(file));
      break;
    case RobotStudy::inflate:
    case RobotStudy::limit:
      static_cast<void>(fem::read_inflation_study(file));
      break;
    case RobotStudy::load_cases:
    case RobotStudy::validate_load_cases:
      static_cast<void>(fem::read_load_case_study(file));
      break;
    case RobotStudy::calibrate:
      break;  // its reader needs the curves: integration_loop
    case RobotStudy::validate:
      static_cast<void>(voxel::read_validation_study(file, {}));
      break;
    case RobotStudy::simulate:
      static_cast<void>(voxel::read_scene(file, {}));
      break;
    case RobotStudy::locomote:
    case RobotStudy::locomote_finer:
      static_cast<void>(fem::read_locomotion_study(file));
      break;
    case RobotStudy::evolve:
      static_cast<void>(evolution::read_study(file));
      break;
    case RobotStudy::reevaluate:
      static_cast<void>(
          evolution::read_reevaluation_study({.archive = "run.sqlite", .file = file}, evolution::read_study(search)));
      break;
  }
}

void expect_studies_are_read(const fs::path& robot_file) {
  const meshes::Robot robot = meshes::read_robot(robot_file);
  const meshes::RobotPlaces places(robot_file);
  for (const RobotStudy study : meshes::robot_studies()) {
    if (!missing_because(robot, study).empty() || (needs_body(study) && !robot.has_body())) continue;
    write_studies(robot, std::array{study}, places);
    EXPECT_NO_THROW(read_study(study, places.study(study), places.study(RobotStudy::evolve))) << places.study(study);
  }
}

TEST(DerivedStudies, OfAllRobotsToBeginWithAreReadByTheirCommands) {
  const tests::TestFolder folder;
  for (const meshes::StartingPoint& start : meshes::starting_points()) {
    const fs::path file = folder / (std::string(start.name) + "/robot.toml");
    io::write_whole(file, robot_template(start, "robot"));
    expect_studies_are_read(file);
  }
}

TEST(DerivedStudies, OfAllSearchesAreReadByTheirCommands) {
  const tests::TestFolder folder;
  const std::string body = "[robot]\ndesign = \"evolve\"\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n[search]\n";
  for (const std::string& search :
       {std::string("model = \"voxels\""), std::string("model = \"both\""), std::string("robust = true"),
        std::string("measure = \"net_displacement\""), std::string("model = \"voxels\"\nmeasure = \"net_displacement\""),
        std::string("[drive]\nfrequency_Hz = 7.0")}) {
    io::write_whole(folder / "robot.toml", body + search + "\n");
    expect_studies_are_read(folder / "robot.toml");
  }
}

TEST(DerivedStudies, HaveTheBodyAndDriveOfTheRobot) {
  const tests::TestFolder folder;
  io::write_whole(folder / "robot.toml", robot_template(meshes::starting_points().front(), "table"));
  const meshes::Robot robot = meshes::read_robot(folder / "robot.toml");
  const meshes::RobotPlaces places(robot.file);
  write_studies(robot, meshes::robot_studies().first(10), places);
  const voxel::LoadedScene voxels = voxel::read_scene(places.study(RobotStudy::simulate), {});
  const fem::LocomotionStudy elements = fem::read_locomotion_study(places.study(RobotStudy::locomote));
  EXPECT_EQ(voxels.scene.design.body, robot.design.body);
  EXPECT_EQ(elements.design.body, robot.design.body);
  EXPECT_EQ(voxels.scene.physics.surrogate->pressure_Pa, drive_pressure_Pa(robot));
  EXPECT_EQ(voxels.scene.duration_s, elements.duration_s);
  const fem::InflationStudy limit = fem::read_inflation_study(places.study(RobotStudy::limit));
  EXPECT_TRUE(static_cast<bool>(limit.path.ends_at));
  EXPECT_FALSE(static_cast<bool>(fem::read_inflation_study(places.study(RobotStudy::inflate)).path.ends_at));
}

}  // namespace
}  // namespace menger
