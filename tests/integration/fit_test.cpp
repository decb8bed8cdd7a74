#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "io/text/csv_table.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "materials/laws/homogeneous_deformations.h"
#include "materials/laws/law_file.h"
#include "materials/laws/study_law.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"

namespace menger {
namespace {

namespace fs = std::filesystem;

/// The program in a folder of its own.
class FitProgram : public testing::Test {
 protected:
  /// Runs the program and returns its exit code. Its output goes to the files out and err.
  [[nodiscard]] int run(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.path().string() + "' && '" MENGER_PROGRAM_DIR "/menger-fit' " + arguments + " >out 2>err";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  [[nodiscard]] std::string text(const char* name) const { return io::read_whole(folder_ / name); }

  /// Writes a tensile test of an Ogden body in which every tenth stress is too high by 100 Pa.
  void write_test(double offset_Pa = 0.0, int rows = 75) const {
    const materials::Ogden<1> law{{materials::OgdenTerm{25e3, 3.25}}};
    std::string csv = "strain,stress_kPa\n";
    for (int i = 1; i <= rows; ++i) {
      const double strain = 1.5 * i / rows;
      const double stress = materials::nominal_stress(law, materials::LoadingMode::uniaxial, 1.0 + strain).stress_Pa;
      csv += io::number_text(strain) + "," + io::number_text(1e-3 * (stress + offset_Pa + (i % 10 == 0 ? 100.0 : 0.0))) + "\n";
    }
    io::write_whole(folder_ / "test.csv", csv);
  }

  const tests::TestFolder folder_;
};

TEST_F(FitProgram, WritesRankingCurvesAndManifest) {
  write_test();
  ASSERT_EQ(run("test.csv -o fits --raw"), 0) << text("err");
  const io::TomlTable table = io::read_toml(folder_ / "fits/fits.toml");
  EXPECT_EQ(table.text("recommended"), "ogden1");
  const io::TomlTable best = table.tables("fits").front();
  EXPECT_NEAR(materials::shear_modulus_at_rest_Pa(materials::read_law(best.table("law"))), 40625.0, 400.0);
  const io::CsvContents curves = io::read_csv(folder_ / "fits/curves.csv");
  EXPECT_EQ(curves.row_count(), 50U);
  EXPECT_NEAR(curves.number(49, "ogden1_stress_Pa"), curves.number(49, "stress_Pa"), 200.0);
  EXPECT_TRUE(fs::exists(folder_ / "fits/manifest.json"));
  EXPECT_NE(fs::exists(folder_ / "fits/fits.png"), text("out").find("no picture: ") != std::string::npos) << text("out");
  EXPECT_NE(text("out").find("recommended: ogden1"), std::string::npos) << text("out");
}

TEST_F(FitProgram, RepairsTheRecordUnlessToldNotTo) {
  write_test(-3000.0);
  ASSERT_EQ(run("test.csv -o repaired --no-pictures"), 0) << text("err");
  EXPECT_NE(text("out").find("zero of the load: -"), std::string::npos) << text("out");
  EXPECT_EQ(io::read_toml(folder_ / "repaired/fits.toml").texts("repairs").size(), 1U);
  EXPECT_EQ(run("test.csv -o raw --raw --no-pictures"), 0) << text("err");
  EXPECT_EQ(text("out").find("zero of the load"), std::string::npos);
  EXPECT_EQ(io::read_toml(folder_ / "raw/fits.toml").texts("repairs").size(), 0U);
}

TEST_F(FitProgram, CorrectsCrossheadStrainOnlyWhenAsked) {
  write_test();
  ASSERT_EQ(run("test.csv -o fits --crosshead-correction 1.5 --raw --no-pictures"), 0) << text("err");
  const io::TomlTable table = io::read_toml(folder_ / "fits/fits.toml");
  EXPECT_EQ(table.texts("repairs").size(), 1U);
  EXPECT_NE(table.texts("repairs")[0].find("divided by 1.5"), std::string::npos);
  EXPECT_NEAR(io::read_csv(folder_ / "fits/curves.csv").number(0, "strain"), 0.02 / 1.5, 1e-12);
}

TEST_F(FitProgram, MakesTheSameFilesEachTime) {
  write_test();
  ASSERT_EQ(run("test.csv -o a --no-pictures"), 0);
  ASSERT_EQ(run("test.csv -o b --no-pictures"), 0);
  for (const char* name : {"fits.toml", "curves.csv"})
    EXPECT_EQ(io::read_whole(folder_ / "a" / name), io::read_whole(folder_ / "b" / name));
}

TEST_F(FitProgram, MakesNoPictureIfToldNotTo) {
  write_test();
  ASSERT_EQ(run("test.csv -o fits --no-pictures"), 0) << text("err");
  EXPECT_FALSE(fs::exists(folder_ / "fits/fits.png"));
  io::write_whole(folder_ / "fits/fits.png", "of another test");
  ASSERT_EQ(run("test.csv -o fits --no-pictures"), 0) << text("err");
  EXPECT_FALSE(fs::exists(folder_ / "fits/fits.png")) << "it would be taken for that of these fits";
  EXPECT_EQ(text("out").find("no picture"), std::string::npos) << text("out");
}

TEST_F(FitProgram, LeavesWithTwoAndAMessageOnBadInput) {
  write_test();
  io::write_whole(folder_ / "no_unit.csv", "strain,stress\n0.1,1\n0.2,2\n");
  io::write_whole(folder_ / "semicolons.csv", "strain;stress_kPa\n0.1;1\n0.2;2\n");
  io::write_whole(folder_ / "no_number.csv", "strain,stress_Pa\n0.1,1\n0.2,much\n");
  for (const auto& [arguments, message] :
       {std::pair{"absent.csv", "absent.csv"},
        {"no_unit.csv", "no_unit.csv:1: header = \"strain,stress\""},
        {"no_number.csv", "no_number.csv:3: stress_Pa"},
        {"test.csv --range 1 0.5", "--range 1 0.5: the first strain must be smaller"},
        {"test.csv --range 0,3", "--range LOW HIGH: needs two strains with a space between them"},
        {"--range 0,3 test.csv", "--range LOW HIGH: needs two strains with a space between them"},
        {"semicolons.csv", "semicolons.csv:1: header = \"strain;stress_kPa\": columns must be separated by"},
        {"test.csv --density 1.07", "--density 1.07: must be in kg/m3"},
        {"test.csv --range 2 3", "test.csv: strain range 2 to 3: holds 0 rows"},
        {"test.csv --crosshead-correction 0.5", "--crosshead-correction 0.5: must be in"},
        {"test.csv --unknown", "--unknown"},
        {"", "test"}}) {
    EXPECT_EQ(run(std::string(arguments) + " -o fits"), 2) << arguments;
    EXPECT_NE(text("err").find(message), std::string::npos) << text("err");
    EXPECT_EQ(text("err").rfind("menger-fit: error: ", 0), 0U) << text("err");
    EXPECT_FALSE(fs::exists(folder_ / "fits")) << arguments;
  }
}

TEST_F(FitProgram, RefusesAFileInPlaceOfTheFolderBeforeAnyWork) {
  write_test(-3000.0);
  for (const std::string folder : {"test.csv", "test.csv/", "test.csv/below"}) {
    EXPECT_EQ(run("test.csv -o " + folder), 2) << folder;
    EXPECT_NE(text("err").find(": is a file, not a folder: choose another -o"), std::string::npos) << text("err");
    EXPECT_EQ(text("out"), "") << "the test is not read";
  }
}

TEST_F(FitProgram, SaysWhichRowsItFits) {
  write_test();
  ASSERT_NE(run("test.csv -o fits --raw --no-pictures"), 2) << text("err");
  EXPECT_NE(text("out").find("fitted to strains of 0.02 to 1 (50 of 75 rows; the test goes to 1.5: --range 0 1.5 takes all)\n"),
            std::string::npos)
      << text("out");
  ASSERT_NE(run("test.csv -o fits --raw --no-pictures --range 0 1.5"), 2) << text("err");
  EXPECT_NE(text("out").find("fitted to strains of 0.02 to 1.5 (75 of 75 rows)\n"), std::string::npos) << text("out");
  EXPECT_EQ(text("out").find("warning"), std::string::npos) << text("out");
  ASSERT_NE(run("test.csv -o fits --raw --no-pictures --range 0.5 2"), 2) << text("err");
  EXPECT_NE(text("out").find("; the test begins at 0.02: --range 0.02 2 takes all)\n"), std::string::npos) << text("out");
}

TEST_F(FitProgram, WarnsOfARangeThatEndsBeyondTheTest) {
  write_test();
  ASSERT_NE(run("test.csv -o fits --raw --no-pictures --range 0 5"), 2) << text("err");
  EXPECT_NE(text("out").find("warning: the range ends at a strain of 5, the test at 1.5\n"), std::string::npos) << text("out");
  const io::TomlTable fits = io::read_toml(folder_ / "fits/fits.toml");
  EXPECT_EQ(fits.number("highest_strain"), 1.5);
  EXPECT_EQ(fits.numbers("range"), (std::vector{0.0, 5.0}));
}

TEST_F(FitProgram, SaysWhichLawsAreUsableAndWhyOthersAreNot) {
  write_test();
  ASSERT_EQ(run("test.csv -o fits --raw --no-pictures"), 0) << text("err");
  const std::string out = text("out");
  EXPECT_NE(out.find("  usable\n"), std::string::npos) << out;
  for (const io::TomlTable& fit : io::read_toml(folder_ / "fits/fits.toml").tables("fits")) {
    const std::size_t begin = out.find("\n" + fit.text("name") + " ") + 1;
    const std::string row = out.substr(begin, out.find('\n', begin) - begin);
    const bool usable = fit.boolean("usable");
    EXPECT_EQ(row.ends_with(" yes"), usable) << row;
    if (!usable) {
      EXPECT_NE(row.find("no: " + fit.texts("not_usable_because").front()), std::string::npos) << row;
    }
  }
}

TEST_F(FitProgram, WritesARecordThatAStudyCanName) {
  write_test();
  ASSERT_EQ(run("test.csv -o fits --raw --no-pictures --density 1070"), 0) << text("err");
  EXPECT_NE(text("out").find("a record of the silicone for studies: fits/silicone.toml"), std::string::npos) << text("out");
  const io::TomlTable fits = io::read_toml(folder_ / "fits/fits.toml");
  const materials::StudyLaw law = materials::recommended_law(folder_ / "fits/silicone.toml");
  EXPECT_EQ(materials::law_text(law.law), materials::law_text(materials::read_law(fits.tables("fits").front().table("law"))));
  EXPECT_EQ(law.largest_stretch, 1.0 + fits.number("highest_strain"));
  EXPECT_EQ(law.record->data_sheet.density_kg_per_m3, 1070.0);
  ASSERT_EQ(run("test.csv -o fits --raw --no-pictures"), 0) << text("err");
  EXPECT_FALSE(fs::exists(folder_ / "fits/silicone.toml")) << "it would be taken for that of these fits";
}

TEST_F(FitProgram, LeavesARecordByHandAlone) {
  write_test();
  fs::create_directory(folder_ / "fits");
  io::write_whole(folder_ / "fits/silicone.toml", "name = \"by hand\"\n");
  EXPECT_EQ(run("test.csv -o fits --raw --no-pictures --density 1070"), 2);
  EXPECT_NE(text("err").find("silicone.toml: was not written by menger fit and is not replaced"), std::string::npos)
      << text("err");
  EXPECT_EQ(run("test.csv -o fits --raw --no-pictures"), 0) << text("err");
  EXPECT_EQ(text("fits/silicone.toml"), "name = \"by hand\"\n");
}

TEST_F(FitProgram, LeavesSoonAfterAnInterrupt) {
  write_test(0.0, 20000);
  const test_support::ProgramRun program(folder_, MENGER_PROGRAM_DIR "/menger-fit", {"test.csv", "-o", "fits", "--no-pictures"});
  program.wait_for_processor_seconds(0.3);
  program.send(SIGINT);
  const test_support::Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.signal << outcome.err;
}

TEST_F(FitProgram, LeavesWithThreeIfNoLawIsToBeUsed) {
  std::string csv = "strain,stress_kPa\n";
  for (int i = 1; i <= 40; ++i) csv += io::number_text(0.02 * i) + "," + io::number_text(-10.0 * i) + "\n";
  io::write_whole(folder_ / "test.csv", csv);
  EXPECT_EQ(run("test.csv -o fits --raw --no-pictures"), 3) << text("err");
  EXPECT_FALSE(io::read_toml(folder_ / "fits/fits.toml").has("recommended"));
}

TEST_F(FitProgram, RecommendsNoLawThatMissesTheTest) {
  const materials::Ogden<1> law{{materials::OgdenTerm{10e3, 8.0}}};
  std::string csv = "stretch,stress_Pa\n";
  for (int i = 1; i <= 60; ++i) {
    const double stretch = 1.0 + 0.02 * i;
    const materials::NominalStress stress = materials::nominal_stress(law, materials::LoadingMode::uniaxial, stretch);
    csv += io::number_text(stretch) + "," + io::number_text(stress.stress_Pa) + "\n";
  }
  io::write_whole(folder_ / "test.csv", csv);
  EXPECT_EQ(run("test.csv -o fits --no-pictures"), 3) << text("err");
  EXPECT_NE(text("out").find("no law is recommended"), std::string::npos) << text("out");
  EXPECT_EQ(text("err"), "") << "nothing of the solver's log";
}

TEST_F(FitProgram, TellsOfRepairsBeforeItRefusesARange) {
  write_test(-3000.0);
  EXPECT_EQ(run("test.csv -o fits --range 2 3"), 2);
  EXPECT_NE(text("out").find("zero of the load: -"), std::string::npos) << text("out");
}

}  // namespace
}  // namespace menger
