#include "tests/unit/evolution/findings/robot_results.h"

namespace menger::evolution {
namespace {

using WalkVerdict = RobotResults;

TEST_F(WalkVerdict, ComparesNoWalkThatEndedEarly) {
  write_walk("simulate/result.toml", 0.04, 0.0);
  write_walk("locomote/locomotion.toml", 0.04, 0.0);
  write_early_walk("locomote_finer/locomotion.toml", 0.04);
  expect_has(verdict(), "The walk on finite elements of the finer mesh ended early and is not compared (diverged: too fast).");
  EXPECT_EQ(verdict().find("agree on the walk"), std::string::npos) << verdict();
  expect_has(verdict(), "The surrogate walks as finite elements do: 40 mm and 40 mm");
  write_early_walk("locomote/locomotion.toml", 0.04);
  EXPECT_EQ(verdict().find("The surrogate"), std::string::npos) << verdict();
}

TEST_F(WalkVerdict, ComparesWalksOfBothModelsAndOfBothMeshes) {
  write_walk("simulate/result.toml", 0.04, 0.0);
  write_walk("locomote/locomotion.toml", -0.006, 0.0);
  write_walk("locomote_finer/locomotion.toml", 0.024, 0.0);
  expect_has(verdict(), "How it walks is not known: 6 mm and 24 mm, 180 degrees apart on finite elements of two meshes.");
  expect_has(verdict(), "So the walk of the surrogate, 40 mm, cannot be judged.");
  write_walk("simulate/result.toml", 2e-6, 0.0, "3.9e-5");
  expect_has(verdict(), "The surrogate does not walk: it ends within 10 % of its length from where it began.");
  EXPECT_EQ(found("simulate"), "it moves 0.002 mm (0 body lengths) in 5 s");
  write_walk("simulate/result.toml", 0.04, 0.0);
  EXPECT_EQ(verdict().find("The surrogate does not walk"), std::string::npos) << verdict();
  write_walk("locomote/locomotion.toml", 0.02, 0.0);
  write_walk("simulate/result.toml", 0.03, 0.0);
  expect_has(verdict(), "Finite elements of two meshes agree on the walk: 20 mm and 24 mm, 0 degrees apart.");
  expect_has(verdict(), "The surrogate walks as finite elements do: 30 mm and 24 mm");
  write_walk("simulate/result.toml", 0.0, 0.024);
  expect_has(verdict(), "The surrogate does not walk as finite elements do: 24 mm and 24 mm, 90 degrees apart");
}

TEST_F(WalkVerdict, TellsADirectionThatIsKnownFromADistanceThatIsNot) {
  write_walk("locomote/locomotion.toml", -0.019, 0.0, "0.53");
  write_walk("locomote_finer/locomotion.toml", -0.030, 0.0, "0.85");
  write_walk("simulate/result.toml", -0.02, 0.0);
  expect_has(verdict(), "How it walks is not known: 19 mm and 30 mm, 0 degrees apart on finite elements of two meshes. Chance");
  expect_has(verdict(), "So the walk of the surrogate, 20 mm, cannot be judged.");
  take_robot("122", "chambers = \"per-phase\"\n[drive]\nmode = \"antiphase\"\npressure_Pa = [0, 3000]\n");
  expect_has(verdict(), "The direction of its walk is known, its distance is not: 19 mm and 30 mm, 0 degrees apart on finite");
  expect_has(verdict(), "The surrogate goes that way, too; its distance, 20 mm, cannot be judged.");
  write_walk("simulate/result.toml", 0.02, 0.0);
  expect_has(verdict(), "The surrogate does not walk as finite elements do: 20 mm and 30 mm, 180 degrees apart");
}

TEST_F(WalkVerdict, BlamesSymmetryOnlyWhereABodyHasIt) {
  const std::string advice = "Chance decides such a walk; a body that differs from its mirror image walks more surely.";
  write_walk("locomote/locomotion.toml", -0.006, 0.0);
  write_walk("locomote_finer/locomotion.toml", 0.024, 0.0);
  expect_has(verdict(), advice);
  take_robot("122", "[drive]\npressure_Pa = [0, 3000]\n");
  expect_has(verdict(), advice);  // one chamber: materials drive nothing apart
  robot_.drive = meshes::RobotDrive::antiphase;
  expect_has(verdict(), "Chance decides such a walk.");
  robot_.drive = meshes::RobotDrive::in_phase;
  write_walk("locomote_finer/locomotion.toml", 0.0, 0.024);
  expect_has(verdict(), advice);
  io::write_whole(folder_ / "robot.toml",
                  "[robot]\nlayers = [[\"110\", \"111\"]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n");
  robot_ = meshes::read_robot(folder_ / "robot.toml");
  expect_has(verdict(), "Chance decides such a walk.");
}

TEST_F(WalkVerdict, MirrorsABodyAboutItselfAndNotAboutItsGrid) {
  const std::string advice = "a body that differs from its mirror image walks more surely.";
  const auto take = [&](const std::string& layer) {
    io::write_whole(folder_ / "robot.toml",
                    "[robot]\nlayers = [[" + layer + "]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n");
    robot_ = meshes::read_robot(folder_ / "robot.toml");
  };
  for (const auto& [x_m, y_m] : {std::pair{0.024, 0.0}, {0.0, 0.024}}) {
    write_walk("locomote/locomotion.toml", -0.25 * x_m, -0.25 * y_m);
    write_walk("locomote_finer/locomotion.toml", x_m, y_m);
    take(R"("110", "110", "000")");
    expect_has(verdict(), advice);
    take(R"("100", "110", "000")");
    EXPECT_EQ(verdict().find(advice), std::string::npos) << verdict();
  }
}

TEST_F(WalkVerdict, SaysOnWhichMeshABodyDoesNotWalk) {
  write_walk("locomote/locomotion.toml", 0.00431, 0.0, "0.12");
  write_walk("locomote_finer/locomotion.toml", 0.0027, 0.0, "0.075");
  expect_has(verdict(),
             "Whether it walks is not known: it moves 4.31 mm and 2.7 mm on finite elements of two meshes, and 2.7 mm is no "
             "walk. The body "
             "is its own mirror image along x: chance decides which way it goes.");
  write_walk("locomote/locomotion.toml", 0.0, 0.002, "0.06");
  write_walk("locomote_finer/locomotion.toml", 0.0, -0.002, "0.06");
  expect_has(verdict(), "from where it began. The body is its own mirror image along y: chance decides which way it goes.");
  io::write_whole(folder_ / "robot.toml",
                  "[robot]\nlayers = [[\"110\", \"111\"]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n");
  robot_ = meshes::read_robot(folder_ / "robot.toml");
  EXPECT_EQ(verdict().find("mirror image"), std::string::npos) << verdict();
}

TEST_F(WalkVerdict, TellsAFallFromAWalk) {
  write_walk("simulate/result.toml", 0.037, 0.0);
  write_walk("locomote/locomotion.toml", 0.02, 0.0);
  write_walk("locomote_finer/locomotion.toml", 0.024, 0.0);
  leave_frames("simulate", {2.0, 3.0, 10.0});
  EXPECT_EQ(found("simulate"), "it moves 37 mm (0.5 body lengths) in 5 s");
  leave_frames("simulate", {2.0, 3.0, 80.0, 85.0});
  EXPECT_EQ(found("simulate"), "it moves 37 mm (0.5 body lengths) in 5 s, but fell over at 1 s: this is no walk");
  expect_has(verdict(), "The body fell over at 1 s in the walk of the surrogate: this is no walk.");
  expect_has(verdict(),
             "The surrogate does not walk as finite elements do: 37 mm and 24 mm, of which the first is a fall (surrogate and");
  leave_frames("locomote_finer", {2.0, 3.0, 80.0});
  expect_has(verdict(),
             "Whether it walks is not known: it moves 20 mm and 24 mm on finite elements of two meshes, and 24 mm is a fall.");
  leave_frames("locomote", {2.0, 90.0, 90.0});
  expect_has(verdict(), "It falls over on finite elements of two meshes: it does not walk.");
  io::write_whole(folder_ / "simulate/frame_0.vtu", "no grid");
  EXPECT_EQ(found("simulate"), "it moves 37 mm (0.5 body lengths) in 5 s") << "the walk is known without its frames";
}

TEST_F(WalkVerdict, ReadsOnlyResultsOfStagesOfThisRobot) {
  write_inflation("completed");
  write_limit("12000.0");
  write_walk("simulate/result.toml", 0.04, 0.0);
  write_walk("locomote/locomotion.toml", 0.04, 0.0);
  write_walk("locomote_finer/locomotion.toml", 0.002, 0.0);
  stages_.erase("locomote_finer");  // as with the finest elements
  EXPECT_EQ(verdict().find("two meshes"), std::string::npos) << verdict();
  expect_has(verdict(), "The surrogate walks as finite elements do: 40 mm and 40 mm");
  stages_.erase("simulate");  // as after a fit that failed
  EXPECT_EQ(verdict().find("surrogate"), std::string::npos) << verdict();
  stages_ = {};
  EXPECT_EQ(verdict(), "");
}

}  // namespace
}  // namespace menger::evolution
