#include "meshes/robot/robot_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/study/study_reader.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "io/text/whole_file.h"
#include "materials/laws/hyperelastic_law.h"
#include "meshes/robot/starting_points.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::meshes {
namespace {

constexpr const char* table = R"([robot]
layers = [["000", "101", "000"], ["111", "111", "111"]]
cell_edge_m = 0.012
wall_thickness_m = 0.0025
silicone = "ecoflex_00_30"
)";

Robot read_text(const tests::TestFolder& folder, const std::string& text) {
  io::write_whole(folder / "robot.toml", text);
  return read_robot(folder / "robot.toml");
}

TEST(RobotFile, NeedsNoMoreThanBodyCellsAndSilicone) {
  const tests::TestFolder folder;
  const Robot robot = read_text(folder, table);
  EXPECT_EQ(robot.design.body.count(), 11U);
  EXPECT_EQ(robot.record.name, "Ecoflex 00-30");
  EXPECT_EQ(robot.design.name, "robot");
  EXPECT_TRUE(robot.walks);
  EXPECT_FALSE(robot.evolves);
  EXPECT_FALSE(robot.search);
}

TEST(RobotFile, PressureOfTheDriveScalesWithSiliconeAndWalls) {
  const tests::TestFolder folder;
  const std::string known = "[robot]\nlayers = [[\"1\"]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n";
  EXPECT_EQ(drive_pressure_Pa(read_text(folder, known))[1], 6000.0);
  // 6 kPa x 39.4 / 86.7 x (2.5 / 7) / (2 / 6)
  EXPECT_EQ(drive_pressure_Pa(read_text(folder, table))[1], 2900.0);
  EXPECT_EQ(drive_pressure_Pa(read_text(folder, std::string(table) + "[drive]\npressure_Pa = [-100, 2000]\n"))[0], -100.0);
}

TEST(RobotFile, LawIsToldWithItsSourceAndWithOtherLawsOfTheSilicone) {
  const tests::TestFolder folder;
  EXPECT_EQ(law_summary_of(read_text(folder, table)),
            "law: initial shear modulus 39.4 kPa (neo_hookean, modulus at 100 % strain of the data sheet divided by 1.75); the "
            "other laws of the record are 0.37 times as stiff (law_name = \"ogden1\") to 0.86 times as stiff (law_name = "
            "\"yeoh\", law_variant = 2). The pressure that a body bears goes nearly with it");
  Robot robot = read_text(folder, table);
  robot.record.others.resize(1);
  EXPECT_NE(law_summary_of(robot).find("; the other law of the record is 0.37 times as stiff (law_name = \"ogden1"),
            std::string::npos);
  robot.law = robot.record.others.front();
  EXPECT_NE(law_summary_of(robot).find("times as stiff (without law_name)"), std::string::npos) << law_summary_of(robot);
  robot.law = robot.record.recommended;
  robot.record.others.clear();
  EXPECT_NE(law_summary_of(robot).find("; the record has no other law"), std::string::npos);
}

TEST(RobotFile, LawIsThatOfTheRecordThatItNames) {
  const tests::TestFolder folder;
  const Robot usual = read_text(folder, table);
  const Robot soft = read_text(folder, std::string(table) + "law_name = \"ogden1\"\n");
  EXPECT_EQ(materials::name_of(usual.law.law), "neo_hookean");
  EXPECT_EQ(materials::name_of(soft.law.law), "ogden1");
  const double ratio = materials::shear_modulus_at_rest_Pa(soft.law.law) / materials::shear_modulus_at_rest_Pa(usual.law.law);
  EXPECT_NEAR(ratio, 0.37, 0.005);
  // two digits
  EXPECT_NEAR(drive_pressure_Pa(soft)[1] / drive_pressure_Pa(usual)[1], ratio, 0.05 * ratio);
  const std::string summary = law_summary_of(soft);
  EXPECT_NE(summary.find("(ogden1, "), std::string::npos) << summary;
  EXPECT_NE(summary.find("times as stiff (without law_name)"), std::string::npos) << summary;
}

TEST(RobotFile, IsToldFromOtherStudiesByItsTable) {
  const tests::TestFolder folder;
  io::write_whole(folder / "robot.toml", table);
  io::write_whole(folder / "design.toml", "[design]\nfile = \"robot.toml\"\n");
  io::write_whole(folder / "broken.toml", "[robot\n");
  io::write_whole(folder / "robot.msh", table);
  EXPECT_TRUE(is_robot_file(folder / "robot.toml"));
  EXPECT_FALSE(is_robot_file(folder / "design.toml"));
  EXPECT_FALSE(is_robot_file(folder / "broken.toml"));
  EXPECT_FALSE(is_robot_file(folder / "robot.msh"));
  EXPECT_FALSE(is_robot_file(folder / "none.toml"));
  EXPECT_FALSE(is_robot_file(folder));
}

TEST(RobotFile, NamesKeyAndValueOfWhatItRefuses) {
  const tests::TestFolder folder;
  const auto expect = [&](const std::string& text, const std::string& part) {
    const std::string message = tests::message_of([&] { static_cast<void>(read_text(folder, text)); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("robot.toml"), std::string::npos) << message;
  };
  const std::string head = "[robot]\nlayers = [[\"1\"]]\ncell_edge_m = 0.01\n";
  const std::string whole = head + "silicone = \"dragon_skin_10\"\n";
  expect("[design]\n", "has no table [robot]");
  expect(head, "robot.silicone is missing");
  expect(head + "silicone = \"rubber\"\n", "silicone = \"rubber\": is neither a file (.toml) nor one of dragon_skin_10");
  expect(whole + "wall_thickness_m = 0.005\n", "wall_thickness_m = 0.005: walls fill a cell");
  expect(whole + "wall_thickness_m = 0.0001\n", "wall_thickness_m = 1e-04: must be at least 0.02 of cell_edge_m, 2e-04");
  expect(whole + "[walk]\nduration_s = 5000\n", "duration_s");
  expect(whole + "wall_thicknes_m = 0.002\n", "did you mean wall_thickness_m?");
  expect(whole + "[drive]\nmode = \"antiphase\"\n", "mode = \"antiphase\": needs robot.chambers = \"per-phase\"");
  expect(whole + "[drive]\npressure_Pa = [3000, 1000]\n", "the lowest comes first");
  expect(whole + "[drive]\npressure_Pa = [-2, 0]\n", "is in pascals");
  expect(whole + "[drive]\npressure_Pa = [0, 0]\n", "must not be 0 all the time");
  expect(whole + "[drive]\npressure_Pa = [-200000, 1000]\n", "is below a perfect vacuum, which is -101325");
  EXPECT_EQ(drive_pressure_Pa(read_text(folder, whole + "[drive]\npressure_Pa = [-3000, -1000]\n"))[1], -1000.0);
  expect(whole + "[drive]\nmode = \"hold\"\npressure_Pa = [-3000, 0]\n", "keeps the highest of pressure_Pa, which is 0");
  expect(whole + "chambers = \"per-phase\"\n[drive]\nmode = \"antiphase\"\n", "needs cells of material 1 and of material 2");
  expect(whole + "[drive]\npressure_Pa = [1]\n", "pressure_Pa");
  expect(whole + "[drive]\npressure_Pa = 3000\n", "pressure_Pa = 3000: must be two numbers");
  expect(whole + "[drive]\npressure_Pa = [0, 7]\n",
         "is in pascals, and 7 kPa are 7000: 7 Pa moves nothing where such walls take some 6000 Pa");
  expect(whole + "[drive]\nfrequency = 7\n", "did you mean frequency_Hz?");
  expect("[robot]\nlayers = [[\"1\"]]\ncell_edge = 0.01\nsilicone = \"dragon_skin_10\"\n",
         "robot.cell_edge_m is missing, is it meant by cell_edge?");
  expect("[robot]\ncell_edge_m = 0,012\n", "decimals have a point");
  expect("[robot]\nsilicone = ecoflex_00_30\n", "text stands in quotes");
  expect(whole + "law_name = \"ogden\"\n", ", did you mean ogden1?");
  expect(whole + "law_name = \"jelly\"\n", "law_name = \"jelly\": the record has recommended, ");
  expect(whole + "law_name = \"ogden1\"\n[search]\nmodel = \"both\"\n", "a search on voxels takes the recommended law");
  EXPECT_EQ(drive_pressure_Pa(read_text(folder, whole + "[drive]\npressure_Pa = [-5000, 50]\n"))[1], 50.0) << "a vacuum moves it";
  const auto expect_body = [&](const std::string& body, const std::string& part) {
    expect("[robot]\nsilicone = \"dragon_skin_10\"\n" + body, part);
  };
  expect_body("layers = [[\"1\"]]\ncell_edge_m = 12\n", "cell_edge_m = 12: is more than 0.5 m: lengths are in metres");
  expect_body("layers = [[\"1\"]]\ncell_edge_m = 0.12\n",
              "cell_edge_m = 0.12: is too large for wall_thickness_m, which is 0.002 if not given and must be at least 0.02");
  expect_body("layers = [[\"1\"]]\ncell_edge_m = \"12mm\"\n", "cell_edge_m = \"12mm\": must be a number (metres)");
  expect_body("layers = [[\"101\"]]\ncell_edge_m = 0.01\n", "robot.layers = [[\"101\"]]: the body is in 2 parts");
  expect_body(
      "layers = [[\"11011111\"]]\ncell_edge_m = 0.01\n",
      ": cells (0, 0, 0) (digit 1 of layers[1][1]), (1, 0, 0) (digit 2 of layers[1][1]) are not joined to the largest part");
  expect_body("layers = [[\"10101010111\"]]\ncell_edge_m = 0.01\n", ", (6, 0, 0) (digit 7 of layers[1][1]) are not joined");
  expect_body("layers = [[\"1010101010111\"]]\ncell_edge_m = 0.01\n",
              ", (6, 0, 0) (digit 7 of layers[1][1]) and 1 more are not joined");
  expect_body("layers = [[010]]\ncell_edge_m = 0.01\n", "a row of digits stands in quotes");
  expect_body("layers = [[111]]\ncell_edge_m = 0.01\n", "layers[1][1] = 111: must be a text in quotes");
  expect_body("cells = [2, 2, 1]\ndigits = \"1001\"\ncell_edge_m = 0.01\n", "robot.digits = \"1001\": the body is in 2 parts");
  expect_body("layers = [[\"10\", \"01\"], [\"11\", \"01\"]]\ncell_edge_m = 0.01\n",
              "cells (0, 0, 0) (digit 1 of layers[1][1]) and (1, 1, 0) (digit 2 of layers[1][2]) touch only along an edge");
  expect_body("cells = [2, 2, 1]\ndigits = \"1001\"\ncell_edge_m = 0.01\n", "cell (1, 1, 0) is not joined");
  expect(whole + "[ground]\nstatic_friction = 0.4\n", "must be at most static_friction, which is 0.4; left out, it is 0.5");
  expect(whole + "[surrogate]\nparameters = \"p.toml\"\nfit_anew = true\n", "fit_anew = true: cannot be true beside parameters");
  expect(whole + "[search]\nmodel = \"voxels\"\nrobust = true\n", "robust = true: needs model");
  expect(whole + "[drive]\nmode = \"hold\"\n[search]\n", "mode = \"hold\": cannot stand beside a search");
  expect(whole + "design = \"evolve\"\n", "layers");
  expect("[robot]\ndesign = \"draw\"\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n", "design = \"draw\"");
}

TEST(RobotFile, TellsWhatItSaysInVain) {
  const tests::TestFolder folder;
  const auto notes = [&](const std::string& more, const std::string& row = "111") {
    io::write_whole(folder / "robot.toml",
                    "[robot]\nlayers = [[\"" + row + "\"]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n" + more);
    return io::joined(read_robot(folder / "robot.toml").notes, "\n");
  };
  const auto has = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  EXPECT_EQ(notes(""), "");
  EXPECT_EQ(notes("[drive]\nmode = \"hold\"\n[walk]\npresent = false\n"), "");
  has(notes("[drive]\nmode = \"hold\"\nfrequency_Hz = 5\n"), "drive.frequency_Hz has no effect");
  has(notes("[drive]\nmode = \"hold\"\n"), "set walk.present = false");
  has(notes("[walk]\npresent = false\nduration_s = 3\n"), "walk.duration_s has no effect");
  has(notes("[drive]\nfrequency_Hz = 0.01\n"), "the walk of 5 s ends within the first stroke, which takes 100 s");
  has(notes("", "112"), "digits 1 and 2 mean the same here");
  EXPECT_EQ(notes("chambers = \"per-phase\"\n", "112"), "");
  EXPECT_EQ(notes("", "222"), "") << "one digit alone misleads nobody";
  has(notes("[search]\n"), "[search] looks for another body");
  has(notes("[search]\n[walk]\npresent = false\n"), "[search] lets its robots walk");
  io::write_whole(folder / "design.toml", "name = \"d\"\ncell_edge_m = 0.012\nlayers = [[\"11\"]]\n");
  io::write_whole(folder / "robot.toml", "[robot]\nfile = \"design.toml\"\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n");
  has(io::joined(read_robot(folder / "robot.toml").notes), "robot.cell_edge_m, 0.01 m, takes the place of that in robot.file");
}

TEST(RobotFile, EvolvedBodiesHaveASearch) {
  const tests::TestFolder folder;
  const Robot robot = read_text(folder, "[robot]\ndesign = \"evolve\"\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n");
  EXPECT_TRUE(robot.evolves);
  EXPECT_FALSE(robot.has_body());
  ASSERT_TRUE(robot.search);
  EXPECT_EQ(robot.search->model, RobotSearchModel::finite_elements);
}

Robot parse(const std::string& text) {
  Robot robot;
  io::read_described(io::parse_toml(text, "robot.toml"), robot);
  return robot;
}

TEST(RobotFile, TemplateAndTextsAreRead) {
  tests::expect_template_is_read<Robot>(parse,
                                        {"robot.file", "drive.mode = \"antiphase\""});  // a file that is not there; one chamber
  tests::expect_texts_are_read_back<Robot>(parse, 5);  // walls, pressures and frictions drawn by chance seldom fit together
}

TEST(StartingPoints, AreRobotsWithTheirOwnBodiesAndWholeComments) {
  const tests::TestFolder folder;
  ASSERT_GE(starting_points().size(), 5U);
  for (const StartingPoint& start : starting_points()) {
    const std::string text = robot_template(start, "mine");
    const Robot read = read_text(folder, text);
    const Robot meant = parse(std::string(start.changes));
    EXPECT_EQ(read.design.body, meant.design.body) << start.name;
    EXPECT_EQ(read.evolves, meant.evolves) << start.name;
    EXPECT_EQ(read.chambers, meant.chambers) << start.name;
    EXPECT_EQ(read.drive, meant.drive) << start.name;
    EXPECT_EQ(read.walks, meant.walks) << start.name;
    EXPECT_EQ(read.design.name, "mine");
    EXPECT_NE(text.find("# Strokes per second."), std::string::npos);
  }
}

}  // namespace
}  // namespace menger::meshes
