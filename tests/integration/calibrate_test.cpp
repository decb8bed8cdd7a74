#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>

#include "io/text/csv_table.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/response_curve.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"
#include "voxel/calibration/calibration_start.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/statics/load_case_response.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using meshes::LoadCaseKind;

constexpr const char* study_text =
    "curves = [\"curves\"]\n"
    "[holds_for]\nsilicone = \"Dragon Skin 10\"\ncell_edge_m = 0.01\nwall_thickness_m = 0.002\n"
    "[fit]\ndetails = [\"uniform\", \"stiffness\"]\n";

/// The program in a folder of its own, with curves that a surrogate of known parameters made.
class CalibrateProgram : public testing::Test {
 protected:
  CalibrateProgram() {
    truth_ = voxel::rough_parameters(provenance(), 1);
    truth_.axial_Pa.fill(150e3);
    truth_.bending_Pa.fill(230e3);
    truth_.torsion_Pa.fill(90e3);
    truth_.extension.fill({.slope_per_Pa = 3e-6, .pressure_softening_per_Pa = 2e-5, .vacuum_softening_per_Pa = -1e-5});
    truth_.bulge.fill({.slope_per_Pa = 5e-7, .pressure_softening_per_Pa = 3e-5, .vacuum_softening_per_Pa = -2e-5});
    truth_.bulge_peak_ratio.fill(2.0);
    add_curve("cell_inflation", LoadCaseKind::inflation, {1, 1, 1}, {-6000, -3000, 3000, 6000, 9000}, {});
    add_curve("bar_inflation", LoadCaseKind::inflation, {3, 1, 1}, {-6000, -3000, 3000, 6000, 9000}, {});
    add_curve("bar_stretch", LoadCaseKind::stretch, {3, 1, 1}, {0, 5000}, {-0.002, 0.002, 0.004});
    add_curve("bar_bending", LoadCaseKind::bending, {3, 1, 1}, {0}, {0.1, 0.2, 0.3});
    add_curve("bar_torsion", LoadCaseKind::torsion, {3, 1, 1}, {0}, {0.1, 0.2, 0.3});
    io::write_whole(folder_ / "study.toml", study_text);
  }

  static meshes::CurveProvenance provenance() {
    meshes::CurveProvenance made;
    made.load_case.cell_edge_m = 0.01;
    made.load_case.wall_thickness_m = 0.002;
    made.silicone = "Dragon Skin 10";
    made.law = "neo_hookean, shear_modulus_Pa = 86677";
    made.shear_modulus_Pa = 86677.0;
    made.density_kg_m3 = 1070.0;
    made.model = "voxel surrogate of known parameters";
    made.relative_uncertainty = 0.02;
    return made;
  }

  void add_curve(const std::string& name, LoadCaseKind kind, const std::array<int, 3>& cells, std::vector<double> pressures_Pa,
                 std::vector<double> imposed) const {
    meshes::ResponseCurve curve;
    curve.provenance = provenance();
    meshes::LoadCase& load_case = curve.provenance.load_case;
    load_case.name = name;
    load_case.kind = kind;
    load_case.cells = cells;
    load_case.digits = std::string(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]), '1');
    load_case.pressures_Pa = std::move(pressures_Pa);
    load_case.imposed = std::move(imposed);
    const voxel::LoadCaseResponse response = voxel::respond(truth_, load_case);
    curve.columns = response.columns;
    curve.values = response.values;
    meshes::write_response_curve(folder_ / "curves", curve);
  }

  /// Runs the program and returns its exit code. Its output goes to the files out and err.
  [[nodiscard]] int run(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.path().string() + "' && '" MENGER_PROGRAM_DIR "/menger-calibrate' " + arguments + " >out 2>err";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  [[nodiscard]] std::string text(const char* name) const { return io::read_whole(folder_ / name); }

  /// Replaces the first occurrence in a file of the folder.
  void replace(const fs::path& file, const std::string& from, const std::string& to) const {
    std::string content = io::read_whole(folder_ / file);
    const std::size_t place = content.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    io::write_whole(folder_ / file, content.replace(place, from.size(), to));
  }

  voxel::SurrogateParameters truth_;
  const tests::TestFolder folder_;
};

TEST_F(CalibrateProgram, FindsTheParametersThatMadeTheCurves) {
  ASSERT_EQ(run("study.toml -o fit --no-pictures"), 0) << text("err");
  const voxel::SurrogateParameters found = voxel::read_surrogate(folder_ / "fit/parameters.toml");
  // without noise; the solver ends when a step changes chi2 by less than 1e-9 of its initial value
  for (std::size_t c = 0; c < voxel::wall_class_count; ++c) {
    EXPECT_NEAR(found.axial_Pa[c], 150e3, 150.0);
    EXPECT_NEAR(found.bending_Pa[c], 230e3, 230.0);
    EXPECT_NEAR(found.torsion_Pa[c], 90e3, 90.0);
    EXPECT_NEAR(found.extension[c].slope_per_Pa, 3e-6, 3e-9);
    EXPECT_NEAR(found.bulge_peak_ratio[c], 2.0, 0.01);
  }
  EXPECT_EQ(found.silicone, "Dragon Skin 10");
  EXPECT_EQ(found.density_kg_m3, 1070.0);
  EXPECT_EQ(found.validity.lowest_pressure_Pa[voxel::gaps::one_cell][voxel::walls::closed], -6000.0);
  EXPECT_EQ(found.validity.highest_pressure_Pa[voxel::walls::closed], 9000.0);
  EXPECT_EQ(found.validity.highest_pressure_Pa[voxel::walls::none], 0.0) << "no body had a cell without walls beside it";
  EXPECT_EQ(found.validity.longest_body_cells, 3);
  EXPECT_FALSE(found.damping_measured);
  const io::TomlTable result = io::read_toml(folder_ / "fit/result.toml").table("fit");
  EXPECT_EQ(result.text("status"), "completed");
  EXPECT_EQ(result.text("details"), "uniform + stiffness");
  EXPECT_TRUE(result.boolean("explained"));
  EXPECT_EQ(result.texts("no_influence"), std::vector<std::string>{"ground_stiffness_N_per_m"});
  EXPECT_NE(text("fit/result.toml").find("damping: not measured"), std::string::npos);
  EXPECT_NE(text("fit/result.toml").find("stiffness of wall class 0, 1, 2a, 2b, 2o, 3: not determined"), std::string::npos)
      << "only tubes were loaded";
  const io::CsvContents details = io::read_csv(folder_ / "fit/details.csv");
  EXPECT_EQ(details.row_count(), 2U);
  for (std::size_t row = 0; row < details.row_count(); ++row) {
    double least = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (const std::string& column : details.columns()) {
      if (!column.starts_with("relative_rms_")) continue;
      least = std::min(least, details.number(row, column));
      largest = std::max(largest, details.number(row, column));
    }
    EXPECT_GT(largest, least) << "the kinds differ";
    EXPECT_GT(details.number(row, "relative_rms"), least);
    EXPECT_LT(details.number(row, "relative_rms"), largest);
  }
  const io::CsvContents parameters = io::read_csv(folder_ / "fit/parameters.csv");
  EXPECT_EQ(parameters.text(0, "parameter"), "axial_Pa");
  EXPECT_EQ(parameters.text(0, "classes"), "0 1 2a 2b 2o 3 4");
  const io::CsvContents residuals = io::read_csv(folder_ / "fit/residuals.csv");
  EXPECT_EQ(residuals.columns(),
            (std::vector<std::string>{"case", "kind", "body", "ordinate", "rms", "worst", "unit", "relative"}));
  for (std::size_t row = 0; row < residuals.row_count(); ++row) EXPECT_LT(residuals.number(row, "relative"), 1e-3);
  for (const char* name : {"parameters.csv", "correlation.csv", "responses.csv", "manifest.json"})
    EXPECT_TRUE(fs::exists(folder_ / "fit" / name)) << name;
}

/// Few curves leave values undetermined: these have a word in place of an interval, and no number that is none.
TEST_F(CalibrateProgram, WritesAWordWhereAValueIsNotDetermined) {
  bool any_undetermined = false;
  for (const char* cases :
       {"\"cell_inflation\", \"bar_stretch\", \"bar_bending\"", "\"cell_inflation\", \"bar_bending\", \"bar_torsion\"",
        "\"bar_inflation\", \"bar_stretch\", \"bar_torsion\""}) {
    io::write_whole(folder_ / "study.toml", "cases = [" + std::string(cases) + "]\n" + study_text);
    const int code = run("study.toml -o fit --no-pictures");
    ASSERT_TRUE(code == 0 || code == 3) << text("err");
    for (const char* name : {"fit/parameters.toml", "fit/result.toml", "fit/parameters.csv", "fit/correlation.csv"}) {
      for (const char* none : {"nan", "inf,", "inf]", "= inf"})
        EXPECT_EQ(text(name).find(none), std::string::npos) << name << ": " << none << " with " << cases;
    }
    const io::CsvContents values = io::read_csv(folder_ / "fit/parameters.csv");
    const io::TomlTable intervals = io::read_toml(folder_ / "fit/parameters.toml").table("fit").table("confidence_95");
    for (std::size_t row = 0; row < values.row_count(); ++row) {
      const std::string name = values.text(row, "parameter");
      const bool is_known = !values.text(row, "lowest_95").empty();
      any_undetermined = any_undetermined || !is_known;
      ASSERT_TRUE(intervals.has(name)) << name << " with " << cases;
      EXPECT_EQ(intervals.is_text(name), !is_known) << name << " with " << cases;
    }
    EXPECT_NO_THROW(static_cast<void>(voxel::read_surrogate(folder_ / "fit/parameters.toml"))) << cases;
  }
  EXPECT_TRUE(any_undetermined);
}

TEST_F(CalibrateProgram, MakesTheSameFilesEachTime) {
  ASSERT_EQ(run("study.toml -o a --no-pictures"), 0) << text("err");
  ASSERT_EQ(run("study.toml -o b --no-pictures"), 0) << text("err");
  for (const char* name : {"parameters.toml", "result.toml", "details.csv", "parameters.csv", "correlation.csv", "residuals.csv"})
    EXPECT_EQ(io::read_whole(folder_ / "a" / name), io::read_whole(folder_ / "b" / name)) << name;
}

TEST_F(CalibrateProgram, DrawsEveryCurve) {
  ASSERT_EQ(run("study.toml -o fit"), 0) << text("err");
  const bool draws = text("out").find("no picture: ") == std::string::npos;
  for (const char* name : {"agreement.png", "curve_cell_inflation.png", "curve_bar_stretch.png", "curve_bar_torsion.png"})
    EXPECT_EQ(fs::exists(folder_ / "fit" / name), draws) << name;
}

TEST_F(CalibrateProgram, TestsItsIntervals) {
  ASSERT_EQ(run("study.toml -o fit --no-pictures --identifiability 3"), 0) << text("err");
  const io::CsvContents table = io::read_csv(folder_ / "fit/identifiability.csv");
  ASSERT_GT(table.row_count(), 5U);
  for (std::size_t row = 0; row < table.row_count(); ++row) EXPECT_LE(table.number(row, "intervals"), 3.0);
}

TEST_F(CalibrateProgram, TakesOtherCurvesAndComparesAFrequencyResponse) {
  // 1 Hz is far below any natural frequency: the gain is that of three cells that extend, and of the middle of the end wall
  const double gain = 0.03 * 3e-6 + 0.01 * 2.0 * 5e-7;
  io::write_whole(folder_ / "response.csv", "frequency_Hz,gain_m_per_Pa\n1," + std::to_string(1e6 * gain) + "e-6\n");
  io::write_whole(folder_ / "study.toml",
                  std::string(study_text).replace(0, 20, "") +
                      "[frequency_response]\nfile = \"response.csv\"\ncells = [3, 1, 1]\ndigits = \"111\"\n");
  ASSERT_EQ(run("study.toml --curves curves -o fit --no-pictures"), 0) << text("err");
  const io::CsvContents table = io::read_csv(folder_ / "fit/frequency_response.csv");
  ASSERT_EQ(table.row_count(), 1U);
  // inertia at 1 Hz adds about (1 Hz / 60 Hz)^2
  EXPECT_NEAR(table.number(0, "relative_error"), 0.0, 1e-3);
}

TEST_F(CalibrateProgram, ReadsTheFrequencyResponseBeforeItFitsAndSaysWhatIsUnanswered) {
  const std::string with_response =
      std::string(study_text) + "[frequency_response]\nfile = \"response.csv\"\ncells = [3, 1, 1]\ndigits = \"111\"\n";
  io::write_whole(folder_ / "study.toml", with_response);
  io::write_whole(folder_ / "response.csv", "frequency_Hz,gain_m_per_kPa\n1,1e-4\n");
  EXPECT_EQ(run("study.toml -o fit --no-pictures"), 2);
  EXPECT_NE(text("err").find("gain_m_per_Pa"), std::string::npos) << text("err");
  EXPECT_FALSE(fs::exists(folder_ / "fit"));
  // outside of the range of the laws there is no equilibrium to vibrate about
  io::write_whole(folder_ / "response.csv", "frequency_Hz,gain_m_per_Pa\n1,1e-7\n2,1e-7\n");
  io::write_whole(folder_ / "study.toml", with_response + "pressure_Pa = 1e9\n");
  EXPECT_EQ(run("study.toml -o fit --no-pictures"), 0) << text("err");
  EXPECT_NE(text("out").find("frequency response: not computed at 2 of 2 frequencies"), std::string::npos) << text("out");
  EXPECT_EQ(text("out").find("largest error"), std::string::npos) << text("out");
}

TEST_F(CalibrateProgram, LeavesNoResultOfAnEarlierRun) {
  ASSERT_EQ(run("study.toml -o fit --no-pictures --identifiability 1"), 0) << text("err");
  io::write_whole(folder_ / "fit/curve_of_another_run.png", "");
  io::write_whole(folder_ / "fit/notes.txt", "of the user");
  const std::string earlier = text("fit/parameters.toml");
  io::write_whole(folder_ / "study.toml", std::string(study_text) + "choice = \"lateral\"\n");
  EXPECT_EQ(run("study.toml -o fit --no-pictures"), 2);
  EXPECT_EQ(text("fit/parameters.toml"), earlier) << "wrong input takes nothing away";
  io::write_whole(folder_ / "study.toml", std::string(study_text) + "largest_iteration_count = 1\n");
  EXPECT_EQ(run("study.toml -o fit --no-pictures"), 3);
  EXPECT_NE(text("fit/parameters.toml"), earlier);
  EXPECT_FALSE(fs::exists(folder_ / "fit/identifiability.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "fit/curve_of_another_run.png"));
  EXPECT_TRUE(fs::exists(folder_ / "fit/notes.txt"));
}

TEST_F(CalibrateProgram, StoppedFitWritesNothingAndSaysSo) {
  const test_support::ProgramRun fit(folder_, MENGER_PROGRAM_DIR "/menger-calibrate", {"study.toml", "-o", "fit"});
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  // It makes the folder right before it begins to fit.
  while (!fs::exists(folder_ / "fit") && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  fit.send(SIGINT);
  const test_support::Outcome stopped = fit.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_EQ(stopped.out, "Stopped. Nothing was written.\n");
  EXPECT_TRUE(fs::is_empty(folder_ / "fit"));
}

TEST_F(CalibrateProgram, TakesDampingFromTheRecord) {
  std::string record = io::read_whole(fs::path(MENGER_SOURCE_DIR) / "materials/data/dragon_skin_10.toml");
  record.replace(record.find("\"damping\", "), 11, "");
  io::write_whole(folder_ / "record.toml", record + "\n[loss]\nsource = \"a test\"\ntan_delta = 0.1\nfrequency_Hz = 1\n");
  io::write_whole(folder_ / "study.toml", std::string("silicone = \"record.toml\"\n") + study_text);
  ASSERT_EQ(run("study.toml -o fit --no-pictures"), 0) << text("err");
  const voxel::SurrogateParameters found = voxel::read_surrogate(folder_ / "fit/parameters.toml");
  EXPECT_TRUE(found.damping_measured);
  EXPECT_GT(found.bond_damping_ratio, 1.0);
}

TEST_F(CalibrateProgram, LeavesWithThreeIfTheFitIsGivenNoTime) {
  io::write_whole(folder_ / "study.toml", std::string(study_text) + "largest_iteration_count = 1\n");
  EXPECT_EQ(run("study.toml -o fit --no-pictures"), 3) << text("err");
  EXPECT_EQ(io::read_toml(folder_ / "fit/parameters.toml").table("fit").text("status"), "not_converged");
}

TEST_F(CalibrateProgram, LeavesWithTwoAndAMessageOnBadInput) {
  const auto refuse = [&](const std::string& study, const std::string& message) {
    io::write_whole(folder_ / "study.toml", study);
    EXPECT_EQ(run("study.toml -o fit"), 2) << message;
    EXPECT_NE(text("err").find(message), std::string::npos) << text("err");
    EXPECT_EQ(text("err").rfind("menger-calibrate: error: ", 0), 0U) << text("err");
    EXPECT_FALSE(fs::exists(folder_ / "fit"));
  };
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = study_text;
    return text.replace(text.find(from), from.size(), to);
  };
  refuse(std::string("cases = [\"bar_stretch\", \"bar_sag\", \"cube\"]\n") + study_text, "there is no curve for bar_sag, cube");
  refuse(with("Dragon Skin 10", "Ecoflex 00-30"), "silicone = \"Dragon Skin 10\": the study is for \"Ecoflex 00-30\"");
  refuse(with("cell_edge_m = 0.01", "cell_edge_m = 0.02"), "cell_edge_m = 0.01: the study is for 0.02");
  refuse(with("wall_thickness_m = 0.002", "wall_thickness_m = 0.001"), "wall_thickness_m = 0.002: the study is for 0.001");
  refuse(with("wall_thickness_m = 0.002", "wall_thickness_m = 0.002\nlaw = \"yeoh\""), "the study is for \"yeoh\"");
  refuse(with("[\"curves\"]", "[\"absent\"]"), "absent");
  refuse(with("[\"curves\"]", "[]"), "at least one");
  refuse(with("\"uniform\"", "\"coarse\""), "must be \"uniform\" | \"stiffness\"");
  refuse(std::string(study_text) + "choice = \"lateral\"\n", "must be one of the details");
  refuse(std::string(study_text) + "[bounds]\naxial_Pa = [2, 1]\n", "the first must be smaller");
  refuse(std::string(study_text) + "[bounds]\naxial_Pa = [-1, 1]\n", "axial_Pa");
  refuse(std::string(study_text) + "[bounds]\naxial_kPa = [1, 2]\n", "axial_kPa");
  refuse(std::string(study_text) + "[frequency_response]\nfile = \"study.toml\"\ncells = [3, 3, 1]\ndigits = \"111111111\"\n" +
             "level = 3\n",
         "frequency_response.level = 3: makes 729 voxels; frequency responses are computed for at most 500");
  refuse(std::string("record = \"record.toml\"\n") + study_text, "is called silicone now");
  refuse(std::string(study_text) + "[weights]\nstretch = 0\n", "weights.stretch = 0");

  replace("curves/bar_stretch.csv", "force_N", "force_mN");
  refuse(study_text, "bar_stretch");
  fs::remove(folder_ / "curves/bar_stretch.toml");
  fs::copy_file(folder_ / "curves/bar_torsion.toml", folder_ / "curves/bar_stretch.toml");
  refuse(study_text, "bar_stretch");
}

}  // namespace
}  // namespace menger
