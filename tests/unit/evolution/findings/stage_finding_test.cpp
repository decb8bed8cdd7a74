#include "tests/unit/evolution/findings/robot_results.h"

namespace menger::evolution {
namespace {

using StageFinding = RobotResults;

TEST_F(StageFinding, TellsWhatTheFilesOfAStageHold) {
  write_walk("simulate/result.toml", 0.03, 0.04);
  EXPECT_EQ(found("simulate"), "it moves 50 mm (0.5 body lengths) in 5 s");
  io::write_whole(folder_ / "locomote/locomotion.toml", "status = \"diverged\"\nreason = \"too fast\"\n");
  EXPECT_EQ(found("locomote"), "diverged: too fast");
  write_limit("12000.0");
  EXPECT_EQ(found("limit"), "it balloons at 12 kPa" + too_high + "25 % of that");
  io::write_whole(folder_ / "inflate/result.toml", "status = \"completed\"\n");
  io::write_whole(folder_ / "inflate/curves.csv", "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1,3000,1.5e-6\n");
  EXPECT_EQ(found("inflate"), "at 3 kPa it holds 50 % more air");
  robot_.drive = meshes::RobotDrive::antiphase;
  io::write_whole(folder_ / "inflate/curves.csv",
                  "step,plenum_0_pressure_Pa,plenum_0_volume_m3,plenum_1_pressure_Pa,plenum_1_volume_m3\n0,0,1e-6,0,2e-6\n"
                  "1,3000,1.5e-6,0,2e-6\n2,0,1e-6,3000,2.4e-6\n");
  EXPECT_EQ(found("inflate"), "at 3 kPa in the chambers of one material, each of them holds 20 to 50 % more air");
  robot_.drive = meshes::RobotDrive::in_phase;
  io::write_whole(folder_ / "mesh/mesh_quality.csv",
                  "quantity,value\nelements,3\nsolid volume_m3,2e-6\nchamber 0 volume_m3,1e-6\nchamber 1 volume_m3,1e-6\n");
  EXPECT_EQ(found("mesh"), "2 cm3 of silicone around 2 cm3 of air");
}

TEST_F(StageFinding, IsEmptyForResultsThatItCannotRead) {
  EXPECT_EQ(found("simulate"), "");
  io::write_whole(folder_ / "simulate/result.toml", "status = ");
  EXPECT_EQ(found("simulate"), "");
}

TEST_F(StageFinding, TakesTheLeastLimitOfAllChambersAndOfTheInflation) {
  io::write_whole(folder_ / "limit/result.toml",
                  "status = \"completed\"\n[[limit_points]]\nplenum = \"plenum 1\"\npressure_Pa = 24000\n");
  EXPECT_EQ(found("limit"), "it balloons at 24 kPa" + too_high + "12 % of that");
  io::write_whole(folder_ / "inflate/result.toml",
                  "status = \"limit_point\"\n[[limit_points]]\nplenum = \"plenum 0\"\npressure_Pa = 2500\n");
  EXPECT_EQ(found("limit"), "it balloons at 2.5 kPa" + too_high + "120 % of that");
  expect_has(verdict(), "It balloons at 2.23 kPa to 2.48 kPa, before the 3 kPa of its drive");
}

TEST_F(StageFinding, TellsInWhichChambersADriveInAntiphaseHasItsPressure) {
  take_robot("122", "chambers = \"per-phase\"\n[drive]\nmode = \"antiphase\"\npressure_Pa = [0, 3000]\n");
  write_inflation("completed");
  const std::string head = "step,plenum_0_pressure_Pa,plenum_0_volume_m3,plenum_1_pressure_Pa,plenum_1_volume_m3\n";
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6,0,2e-6\n1,3000,1.5e-6,0,1.8e-6\n2,0,0.9e-6,3000,3e-6\n");
  EXPECT_EQ(found("inflate"), "at 3 kPa in the chambers of one material, each of them holds 50 % more air");
  write_inflation("wall_contact");
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6,0,2e-6\n1,2600,1.5e-6,0,1.8e-6\n");
  EXPECT_EQ(found("inflate"), "walls of a chamber touch at 2.6 kPa in the chambers of one material");
  expect_has(
      verdict(),
      "Walls of a chamber touch at 2.6 kPa in the chambers of one material by thin walls (inflate), before the 3 kPa of its "
      "drive. ");
  write_limit("12000");
  expect_has(verdict(), "It bears its pressure of 3 kPa: safe up to 8.57 kPa");
}

TEST_F(StageFinding, TellsWhichRobotASearchFoundAndWhatItsElementsRefused) {
  io::write_whole(folder_ / "logs/evolve.txt",
                  "Champion: individual 3, 5 cells; number 2 of the search: 0.01\nNext: menger export\n");
  EXPECT_EQ(found("evolve"), "Champion: individual 3, 5 cells");
  EXPECT_EQ(verdict(), "") << "the search is not of this robot";
  stages_.insert("evolve");
  EXPECT_EQ(
      verdict(),
      "The best robot of the search, which is not the body of this file: individual 3, 5 cells; number 2 of the search: 0.01.");
  robot_.evolves = true;
  expect_has(verdict(), "The best robot of the search: individual 3");
  io::write_whole(folder_ / "logs/evolve.txt",
                  "Champion: individual 3, 5 cells; 0.01 in the search\nnote: the champion does not walk: at this speed it moves "
                  "0.05 body lengths\nNext: menger export\n");
  EXPECT_EQ(verdict(),
            "The best robot of the search: individual 3, 5 cells; 0.01 in the search. It does not walk: at this speed it moves "
            "0.05 body lengths.");
  io::write_whole(folder_ / "logs/evolve.txt",
                  "note: finite elements refused 2 of 11 bodies\nChampion: individual 3, 5 cells\nNext: menger export\n");
  EXPECT_EQ(found("evolve"), "Champion: individual 3, 5 cells; finite elements refused 2 of 11 bodies");
}

}  // namespace
}  // namespace menger::evolution
