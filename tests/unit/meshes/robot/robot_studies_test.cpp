#include "meshes/robot/robot_studies.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "meshes/robot/calibration_cases.h"
#include "meshes/robot/command_study.h"
#include "meshes/robot/known_parameters.h"
#include "meshes/robot/robot_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

constexpr const char* body = "[robot]\nlayers = [[\"1111\"]]\n";
const fs::path source(MENGER_SOURCE_DIR);

Robot robot_of(const tests::TestFolder& folder, const std::string& cells) {
  io::write_whole(folder / "robot.toml", body + cells);
  return read_robot(folder / "robot.toml");
}

const char* const dragon_skin_1cm = "cell_edge_m = 0.01\nwall_thickness_m = 0.002\nsilicone = \"dragon_skin_10\"\n";
const char* const ecoflex_12mm = "cell_edge_m = 0.012\nwall_thickness_m = 0.0025\nsilicone = \"ecoflex_00_30\"\n";

/// Compares two sets of load cases number by number.
/// @param largest_element_m of the cases that are made
/// @param tolerance of pressures in pascals, relative
void expect_same_cases(const io::TomlTable& made, const io::TomlTable& shipped, double largest_element_m, double tolerance) {
  EXPECT_EQ(made.text("silicone"), shipped.text("silicone"));
  for (const char* key : {"cell_edge_m", "wall_thickness_m"})
    EXPECT_DOUBLE_EQ(made.table("body").number(key), shipped.table("body").number(key));
  // Those of a robot may be coarser, so that they are computed in minutes: curves that come with menger are made once.
  EXPECT_DOUBLE_EQ(made.table("elements").number("largest_element_m"), largest_element_m);
  for (const char* key : {"degree", "growth"})
    EXPECT_DOUBLE_EQ(made.table("elements").number(key), shipped.table("elements").number(key)) << key;
  const std::vector<io::TomlTable> one = made.tables("case");
  const std::vector<io::TomlTable> other = shipped.tables("case");
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t n = 0; n < one.size(); ++n) {
    const std::string name = other[n].text("name");
    for (const char* key : {"name", "kind", "digits"}) EXPECT_EQ(one[n].text(key), other[n].text(key)) << name;
    EXPECT_EQ(one[n].integer_or<int>("level", 1), other[n].integer_or<int>("level", 1)) << name;
    for (const char* key : {"cells", "pressure_fractions", "displacement_m", "angle_rad", "gravity_factor", "pressures_Pa"}) {
      ASSERT_EQ(one[n].has(key), other[n].has(key)) << name << " " << key;
      if (!one[n].has(key)) continue;
      const std::vector<double> mine = one[n].numbers(key);
      const std::vector<double> theirs = other[n].numbers(key);
      ASSERT_EQ(mine.size(), theirs.size()) << name << " " << key;
      const bool is_pressure = std::string(key) == "pressures_Pa";
      for (std::size_t i = 0; i < mine.size(); ++i)
        EXPECT_NEAR(mine[i], theirs[i], (is_pressure ? tolerance : 1e-12) * std::abs(theirs[i])) << name << " " << key;
    }
  }
}

io::TomlTable load_cases_of(const Robot& robot) {
  return io::parse_toml(study_text(robot, RobotStudy::load_cases, RobotPlaces(robot.file)), "load_cases.toml");
}

TEST(CalibrationCases, AreThoseThatComeWithMengerForTheSameCells) {
  const tests::TestFolder folder;
  expect_same_cases(load_cases_of(robot_of(folder, dragon_skin_1cm)),
                    io::read_toml(source / "fem/studies/load_cases/dragon_skin_10_1cm.toml"), 0.006, 0.0);
  // The pressures of its slab on legs were chosen by hand.
  expect_same_cases(load_cases_of(robot_of(folder, ecoflex_12mm)),
                    io::read_toml(source / "fem/studies/load_cases/ecoflex_00_30_12mm.toml"), 0.007, 0.2);
}

TEST(CalibrationCases, TheirNamesAreFitted) {
  const tests::TestFolder folder;
  const Robot robot = robot_of(folder, dragon_skin_1cm);
  const io::TomlTable fit = io::parse_toml(study_text(robot, RobotStudy::calibrate, RobotPlaces(robot.file)), "calibrate.toml");
  EXPECT_EQ(fit.texts("cases"), calibration_case_names());
  std::vector<std::string> made;
  for (const io::TomlTable& load : load_cases_of(robot).tables("case")) made.push_back(load.text("name"));
  EXPECT_EQ(made, calibration_case_names());
}

TEST(CalibrationCases, BodiesOfTheFitCannotTestIt) {
  const tests::TestFolder folder;
  Robot robot = robot_of(folder, dragon_skin_1cm);
  EXPECT_EQ(missing_because(robot, RobotStudy::validate), "");
  robot.design.body = Polycube::from_digits(2, 2, 1, "1110");
  EXPECT_NE(missing_because(robot, RobotStudy::validate).find("fitted to this very body"), std::string::npos);
  robot.parameters = "mine.toml";
  EXPECT_EQ(missing_because(robot, RobotStudy::validate), "");
}

TEST(CalibrationCases, BodiesOfTheFitAreTheSameInTheOtherMaterial) {
  const tests::TestFolder folder;
  Robot robot = robot_of(folder, dragon_skin_1cm);
  robot.chambers = ChamberLayout::per_phase;
  robot.design.body = Polycube::from_digits(2, 2, 1, "2220");
  EXPECT_TRUE(is_fitted_body(robot));
  robot.design.body = Polycube::from_digits(2, 2, 1, "1220");
  EXPECT_FALSE(is_fitted_body(robot)) << "two chambers";
  robot.chambers = ChamberLayout::single;
  EXPECT_TRUE(is_fitted_body(robot));
  EXPECT_EQ(longest_fitted_body_cells(), 3);
}

TEST(CalibrationCases, ScaleWithCellsAndWalls) {
  const tests::TestFolder folder;
  const io::TomlTable set =
      load_cases_of(robot_of(folder, "cell_edge_m = 0.02\nwall_thickness_m = 0.003\nsilicone = \"dragon_skin_20\"\n"));
  EXPECT_DOUBLE_EQ(set.table("elements").number("largest_element_m"), 0.014);
  for (const io::TomlTable& load : set.tables("case")) {
    if (load.text("name") != "cell_press") continue;
    EXPECT_EQ(load.numbers("displacement_m"), (std::vector{0.0002, 0.0005, 0.001, 0.002}));
  }
}

TEST(KnownParameters, AreThoseOfExactlyTheseCells) {
  const tests::TestFolder folder;
  const auto name = [&](const std::string& cells) {
    const std::optional<fs::path> file = known_parameters(robot_of(folder, cells));
    return file ? file->filename().string() : "";
  };
  EXPECT_EQ(name(dragon_skin_1cm), "dragon_skin_10_1cm.toml");
  EXPECT_EQ(name(ecoflex_12mm), "ecoflex_00_30_12mm.toml");
  EXPECT_EQ(name("cell_edge_m = 0.012\nwall_thickness_m = 0.0024\nsilicone = \"ecoflex_00_30\"\n"), "");
  EXPECT_EQ(name("cell_edge_m = 0.012\nwall_thickness_m = 0.0025\nsilicone = \"ecoflex_00_50\"\n"), "");
}

TEST(KnownParameters, TellInWhatOtherCellsDiffer) {
  const tests::TestFolder folder;
  const fs::path file = *known_parameters(robot_of(folder, ecoflex_12mm));
  EXPECT_TRUE(other_subject_of(file, robot_of(folder, ecoflex_12mm)).empty());
  EXPECT_EQ(
      other_subject_of(file, robot_of(folder, "cell_edge_m = 0.01\nwall_thickness_m = 0.0025\nsilicone = \"ecoflex_00_30\"\n")),
      std::vector<std::string>{"cell_edge_m 0.012 in place of 0.01"});
  const std::vector<std::string> soft =
      other_subject_of(file, robot_of(folder, ecoflex_12mm + std::string("law_name = \"ogden1\"\n")));
  ASSERT_EQ(soft.size(), 1U);
  EXPECT_TRUE(soft.front().starts_with("law name = \"neo_hookean\", shear_modulus_Pa = 39399 in place of name = \"ogden1\""))
      << soft.front();
}

TEST(RobotStudies, TakeTheParametersThatAreGivenKnownOrFitted) {
  const tests::TestFolder folder;
  const auto parameters = [&](const std::string& more) {
    const Robot robot = robot_of(folder, dragon_skin_1cm + more);
    return io::parse_toml(study_text(robot, RobotStudy::simulate, RobotPlaces(robot.file)), "x")
        .table("surrogate")
        .text("parameters");
  };
  EXPECT_EQ(parameters(""), "dragon_skin_10_1cm");
  EXPECT_EQ(parameters("[surrogate]\nfit_anew = true\n"), "../calibrate/parameters.toml");
  EXPECT_EQ(parameters("[surrogate]\nparameters = \"mine.toml\"\n"), "../../mine.toml");
}

TEST(RobotStudies, InflateWhatDoesNotWalkWithoutAGround) {
  const tests::TestFolder folder;
  const auto supports = [&](const std::string& more, RobotStudy study) {
    const Robot robot = robot_of(folder, dragon_skin_1cm + more);
    const io::TomlTable text = io::parse_toml(study_text(robot, study, RobotPlaces(robot.file)), "x");
    return text.is_table("supports") ? text.table("supports").text("kind") : "";
  };
  for (const RobotStudy study : {RobotStudy::inflate, RobotStudy::limit}) {
    EXPECT_EQ(supports("", study), "");
    EXPECT_EQ(supports("[walk]\npresent = false\n", study), "free");
  }
}

TEST(RobotStudies, CompareShapesAtThePressuresOfTheDrive) {
  const tests::TestFolder folder;
  const auto pressures_Pa = [&](const std::string& drive) {
    const Robot robot = robot_of(folder, std::string(dragon_skin_1cm) + "[drive]\npressure_Pa = " + drive + "\n");
    return io::parse_toml(study_text(robot, RobotStudy::validate_load_cases, RobotPlaces(robot.file)), "x")
        .tables("case")
        .front()
        .numbers("pressures_Pa");
  };
  using Values = std::vector<double>;
  EXPECT_EQ(pressures_Pa("[0, 6000]"), (Values{1000, 2000, 3000, 4000, 5000, 6000}));
  EXPECT_EQ(pressures_Pa("[3000, 6000]"), pressures_Pa("[0, 6000]"));
  EXPECT_EQ(pressures_Pa("[-3, 6000]"), (Values{-3, -2.5, -2, -1.5, -1, -0.5, 1000, 2000, 3000, 4000, 5000, 6000}));
  EXPECT_EQ(pressures_Pa("[-300, 6000]"), (Values{-300, -250, -200, -150, -100, -50, 1000, 2000, 3000, 4000, 5000, 6000}));
}

TEST(RobotStudies, InflateToTheStatesThatTheDrivePassesThrough) {
  const tests::TestFolder folder;
  const auto path = [&](const std::string& more, RobotStudy study) {
    const Robot robot = robot_of(folder, dragon_skin_1cm + more);
    return io::parse_toml(study_text(robot, study, RobotPlaces(robot.file)), "x").table("path");
  };
  using Values = std::vector<double>;
  const auto pressures_Pa = [&](const std::string& drive) {
    return path("[drive]\npressure_Pa = " + drive + "\n", RobotStudy::inflate).numbers("pressure_Pa");
  };
  EXPECT_EQ(pressures_Pa("[0, 6000]"), (Values{0, 6000}));
  EXPECT_EQ(pressures_Pa("[-2000, 6000]"), (Values{0, 6000, 0, -2000})) << "vacuum last: walls that touch end a path";
  EXPECT_EQ(pressures_Pa("[-2000, 0]"), (Values{0, -2000, 0}));
  Robot robot = robot_of(folder, dragon_skin_1cm + std::string("chambers = \"per-phase\"\n"));
  robot.design.body = Polycube::from_digits(3, 1, 1, "122");
  robot.drive = RobotDrive::antiphase;
  robot.pressure_Pa = {-100.0, 6000.0};
  const auto plena =
      io::parse_toml(study_text(robot, RobotStudy::inflate, RobotPlaces(robot.file)), "x").table("path").tables("plenum");
  ASSERT_EQ(plena.size(), 2U);
  EXPECT_EQ(plena[0].text("name"), "plenum 0");
  EXPECT_EQ(plena[0].numbers("pressure_Pa"), (Values{0, 6000, -100})) << "material 1";
  EXPECT_EQ(plena[1].numbers("pressure_Pa"), (Values{0, -100, 6000})) << "material 2";
  EXPECT_EQ(path("", RobotStudy::limit).numbers("volume_ratio"), (Values{1, 40}));
  EXPECT_EQ(path("chambers = \"per-phase\"\n", RobotStudy::limit).numbers("pressure_Pa"), (Values{0, 60000}))
      << "chambers of different sizes have one pressure";
  EXPECT_EQ(
      missing_because(robot_of(folder, dragon_skin_1cm + std::string("[drive]\npressure_Pa = [-2000, 0]\n")), RobotStudy::limit),
      "drive.pressure_Pa is nowhere above 0");
}

TEST(RobotStudies, NameASiliconeOfTheUserFromTheirOwnFolder) {
  const tests::TestFolder folder;
  fs::copy_file(source / "materials/data/ecoflex_00_30.toml", folder / "mine.toml");
  const Robot robot = robot_of(folder, "cell_edge_m = 0.01\nsilicone = \"./mine.toml\"\n");
  const io::TomlTable study = io::parse_toml(study_text(robot, RobotStudy::inflate, RobotPlaces(robot.file)), "x");
  EXPECT_EQ(study.table("material").text("silicone"), "../../mine.toml");
}

TEST(RobotStudies, TakeTheLawThatTheRobotNames) {
  const tests::TestFolder folder;
  const auto law_name = [&](const std::string& more, RobotStudy study, const std::string& in) {
    const Robot robot = robot_of(folder, dragon_skin_1cm + more);
    const io::TomlTable text = io::parse_toml(study_text(robot, study, RobotPlaces(robot.file)), "x");
    return (in.empty() ? text : text.table(in)).text_or("law_name", "");
  };
  const std::string soft = "law_name = \"ogden1\"\n";
  for (const RobotStudy study : {RobotStudy::inflate, RobotStudy::limit, RobotStudy::locomote}) {
    EXPECT_EQ(law_name("", study, "material"), "");
    EXPECT_EQ(law_name(soft, study, "material"), "ogden1");
  }
  EXPECT_EQ(law_name(soft, RobotStudy::load_cases, ""), "ogden1");
  EXPECT_EQ(law_name(soft, RobotStudy::validate_load_cases, ""), "ogden1");
  EXPECT_EQ(law_name(soft + "[search]\n", RobotStudy::evolve, "material"), "ogden1");
  // Parameters that come with menger hold for the recommended law.
  EXPECT_EQ(parameter_source(robot_of(folder, dragon_skin_1cm)), ParameterSource::known);
  EXPECT_EQ(parameter_source(robot_of(folder, dragon_skin_1cm + soft)), ParameterSource::fitted);
}

TEST(CommandStudy, DerivesStudyAndFolderFromARobotAlone) {
  const tests::TestFolder folder;
  const Robot robot = robot_of(folder, dragon_skin_1cm);
  const CommandStudy derived = command_study(robot.file, RobotStudy::validate);
  EXPECT_EQ(derived.study, folder / "results/studies/validate.toml");
  EXPECT_EQ(derived.folder, folder / "results/validate");
  EXPECT_EQ(command_study(folder.path(), RobotStudy::validate).study, derived.study) << "the folder means its robot.toml";
  EXPECT_EQ(io::read_whole(derived.study), study_text(robot, RobotStudy::validate, RobotPlaces(robot.file)));
  EXPECT_TRUE(fs::exists(folder / "results/studies/validate_load_cases.toml"));
  io::write_whole(folder / "study.toml", "[design]\n");
  EXPECT_NE(tests::message_of([&] {
              refuse_robot_file(robot.file);
            }).find("is the file of a robot, not a study of this command (--template prints one): menger loop"),
            std::string::npos);
  EXPECT_NO_THROW(refuse_robot_file(folder / "study.toml"));
  const CommandStudy own = command_study(folder / "study.toml", RobotStudy::validate);
  EXPECT_EQ(own.study, folder / "study.toml");
  EXPECT_EQ(own.folder, "study");
}

TEST(CommandStudy, FolderThatTheUserNamesTakesTheStudiesToo) {
  const tests::TestFolder folder;
  const Robot robot = robot_of(folder, dragon_skin_1cm);
  const CommandStudy derived = command_study(robot.file, RobotStudy::simulate, folder / "mine");
  EXPECT_EQ(derived.study, folder / "mine/studies/simulate.toml");
  EXPECT_EQ(derived.folder, folder / "mine");
  const CommandStudy validate = command_study(robot.file, RobotStudy::validate, folder / "mine");
  EXPECT_NE(io::read_whole(validate.study).find("\"../curves\""), std::string::npos) << io::read_whole(validate.study);
  EXPECT_FALSE(fs::exists(folder / "results")) << "nothing is left beside a robot that one may only read";
}

TEST(CommandStudy, SaysWhichFitComesFirst) {
  const tests::TestFolder folder;
  static_cast<void>(robot_of(folder, "cell_edge_m = 0.012\nwall_thickness_m = 0.003\nsilicone = \"ecoflex_00_30\"\n"));
  const auto made = [&](RobotStudy study, bool has_own_fit = false) {
    return command_study(folder / "robot.toml", study, {}, has_own_fit).study;
  };
  const auto expect = [&](RobotStudy study, const std::string& part) {
    const std::string message = tests::message_of([&] { static_cast<void>(made(study)); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(RobotStudy::simulate, "voxels have not been fitted to these cells: first menger loop ");
  expect(RobotStudy::validate, " --until calibrate");
  expect(RobotStudy::calibrate, " --until load_cases, or name a folder of curves with --curves");
  EXPECT_FALSE(fs::exists(folder / "results")) << "a refusal writes nothing";
  EXPECT_EQ(made(RobotStudy::calibrate, true), folder / "results/studies/calibrate.toml") << "with --curves";
  EXPECT_EQ(made(RobotStudy::validate, true), folder / "results/studies/validate.toml") << "with --parameters";
  fs::create_directories(folder / "results/load_cases");
  EXPECT_EQ(made(RobotStudy::calibrate), folder / "results/studies/calibrate.toml");
  io::write_whole(folder / "results/calibrate/parameters.toml", "");
  EXPECT_EQ(made(RobotStudy::simulate), folder / "results/studies/simulate.toml");
}

TEST(CommandStudy, SaysHowToFitCellsAnewThatMengerKnows) {
  const tests::TestFolder folder;
  const Robot robot = robot_of(folder, dragon_skin_1cm);
  const std::string message = tests::message_of([&] { static_cast<void>(command_study(robot.file, RobotStudy::calibrate)); });
  EXPECT_NE(message.find("menger comes with voxels for these cells; to fit them anew, first menger loop "), std::string::npos);
  EXPECT_NE(message.find(" --fit --until load_cases"), std::string::npos) << message;
  EXPECT_NO_THROW(static_cast<void>(command_study(robot.file, RobotStudy::simulate)));
}

TEST(CommandStudy, SaysWhyARobotHasNoSuchStudy) {
  const tests::TestFolder folder;
  const auto message = [&](RobotStudy study) {
    return tests::message_of([&] { static_cast<void>(command_study(folder / "robot.toml", study)); });
  };
  static_cast<void>(robot_of(folder, std::string(dragon_skin_1cm) + "[walk]\npresent = false\n"));
  EXPECT_NE(message(RobotStudy::locomote).find("walk.present = false"), std::string::npos) << message(RobotStudy::locomote);
  io::write_whole(folder / "robot.toml", std::string("[robot]\ndesign = \"evolve\"\n") + dragon_skin_1cm);
  EXPECT_NE(message(RobotStudy::inflate).find("no search has found a body yet"), std::string::npos)
      << message(RobotStudy::inflate);
  io::write_whole(folder / "results/export/champion.toml", "name = \"c\"\ncell_edge_m = 0.01\nlayers = [[\"11\"]]\n");
  EXPECT_EQ(io::read_toml(command_study(folder / "robot.toml", RobotStudy::inflate).study).table("design").text("digits"), "11");
}

}  // namespace
}  // namespace menger::meshes
