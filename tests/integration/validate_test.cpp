#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/response_curve.h"
#include "tests/support/paraview_files.h"
#include "tests/support/program_run.h"
#include "tests/support/surrogate_example.h"
#include "tests/support/test_folder.h"
#include "voxel/model/expected_errors.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/statics/load_case_response.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using meshes::LoadCaseKind;

voxel::SurrogateParameters truth() {
  voxel::SurrogateParameters parameters = tests::plain_surrogate_example();
  parameters.extension.fill({.slope_per_Pa = 4e-6});
  return parameters;
}

/// The program in a folder of its own, with curves that the surrogate made with the true parameters.
class ValidateProgram : public testing::Test {
 protected:
  ValidateProgram() {
    write_curve("curves", "bar_inflation", LoadCaseKind::inflation, {-2e3, 0.0, 3e3, 6e3}, {});
    write_curve("curves", "bar_stretch", LoadCaseKind::stretch, {0.0, 4e3}, {0.0, 5e-4, 1e-3});
    write_curve("curves", "bar_modes", LoadCaseKind::modes, {0.0, 4e3}, {});
    write_parameters(truth());
    io::write_whole(folder_ / "study.toml", "parameters = 'parameters.toml'\ncurves = ['curves']\n");
  }

  void write_curve(const std::string& place, const std::string& name, LoadCaseKind kind, const std::vector<double>& pressures_Pa,
                   const std::vector<double>& imposed) const {
    meshes::ResponseCurve curve;
    meshes::LoadCase& load_case = curve.provenance.load_case;
    load_case.name = name;
    load_case.kind = kind;
    load_case.cells = {3, 1, 1};
    load_case.digits = "111";
    load_case.cell_edge_m = 0.01;
    load_case.wall_thickness_m = 0.002;
    load_case.pressures_Pa = pressures_Pa;
    load_case.imposed = imposed;
    curve.provenance.silicone = truth().silicone;
    curve.provenance.law = truth().law;
    curve.provenance.shear_modulus_Pa = 86.7e3;
    curve.provenance.density_kg_m3 = 1070.0;
    curve.provenance.model = "the surrogate itself";
    curve.provenance.relative_uncertainty = 0.05;
    const voxel::LoadCaseResponse response = voxel::respond(truth(), load_case);
    curve.columns = response.columns;
    curve.values = response.values;
    meshes::write_response_curve(folder_ / place, curve);
  }

  void write_parameters(const voxel::SurrogateParameters& parameters, const std::string& fit = "") const {
    io::write_whole(folder_ / "parameters.toml", voxel::surrogate_text(parameters) + fit);
  }

  [[nodiscard]] test_support::Outcome run(std::vector<std::string> arguments) const {
    return test_support::ProgramRun(folder_, MENGER_PROGRAM_DIR "/menger-validate", std::move(arguments)).wait();
  }

  const tests::TestFolder folder_;
};

TEST_F(ValidateProgram, FindsNoErrorInAModelOfItself) {
  const auto outcome = run({"study.toml", "-o", "out", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents errors = io::read_csv(folder_ / "out/errors.csv");
  EXPECT_GT(errors.row_count(), 20U);
  // the equilibria and the path are the same, and the tables have all digits
  for (std::size_t row = 0; row < errors.row_count(); ++row) EXPECT_NEAR(errors.number(row, "error"), 0.0, 1e-9) << row;
  EXPECT_NE(outcome.out.find("displacement: median error"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(": met"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("it is not known whether these are held out"), std::string::npos);
  EXPECT_EQ(io::read_csv(folder_ / "out/volume_actuation.csv").row_count(), 1U);
  EXPECT_TRUE(fs::exists(folder_ / "out/worst.pvd"));
  test_support::expect_opens_in_paraview(folder_ / "out");
  EXPECT_TRUE(fs::exists(folder_ / "out/manifest.json"));
}

TEST_F(ValidateProgram, KeepsExpectedErrorsBesideTheParametersIfToldTo) {
  ASSERT_EQ(run({"study.toml", "-o", "out", "--no-pictures"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "parameters.errors.csv"));
  ASSERT_EQ(run({"study.toml", "-o", "out", "--no-pictures", "--keep"}).code, 0);
  EXPECT_EQ(io::read_whole(folder_ / "parameters.errors.csv"), io::read_whole(folder_ / "out/expected_errors.csv"));
  const auto errors = voxel::read_expected_errors(folder_ / "parameters.toml");
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->parameters_hash, voxel::hash_of(truth()));
  const auto& limbs = errors->of(voxel::BodyKind::limbs);
  ASSERT_TRUE(limbs);
  EXPECT_EQ(limbs->bodies, std::vector<std::string>{"bar"});
  EXPECT_NEAR(limbs->displacement_ninth_decile.value(), 0.0, 1e-9);
}

TEST_F(ValidateProgram, MeasuresAKnownErrorAndFindsItsCause) {
  voxel::SurrogateParameters parameters = truth();
  for (voxel::PressureLaw& law : parameters.extension) law.slope_per_Pa *= 0.75;
  write_parameters(parameters);
  const auto outcome = run({"study.toml", "-o", "out", "--explain"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents errors = io::read_csv(folder_ / "out/errors.csv");
  int found = 0;
  for (std::size_t row = 0; row < errors.row_count(); ++row) {
    if (errors.text(row, "case") != "bar_inflation" || errors.text(row, "observable") != "extent_x_m") continue;
    // the free length of the bar grows by the extension of 3 cells and by two bulging ends: 4e-6 * 3 + 6e-6 * 2 of a cell
    const double too_short = errors.number(row, "pressure_Pa") > 0.0 ? -1.0 : 1.0;
    EXPECT_NEAR(errors.number(row, "pointwise_error"), too_short * 0.25 * 12.0 / 24.0, 1e-6);
    ++found;
  }
  EXPECT_EQ(found, 3) << "the state at rest is left out";
  EXPECT_NE(outcome.out.find("rest lengths fitted to this body remove the error"), std::string::npos) << outcome.out;
  const bool has_pictures = outcome.out.find("no picture: ") == std::string::npos;
  for (const char* name : {"errors.png", "curve_bar_stretch.png", "worst.png"})
    EXPECT_EQ(fs::exists(folder_ / "out" / name), has_pictures);
  EXPECT_NE(io::read_whole(folder_ / "out/report.txt").find("rest lengths"), std::string::npos);
}

TEST_F(ValidateProgram, LeavesWithThreeWhereTheSurrogateHasNoEquilibrium) {
  voxel::SurrogateParameters parameters = truth();
  parameters.validity.set_pressures(-5e3, 4e3);
  for (voxel::PressureLaw& law : parameters.extension) law.pressure_softening_per_Pa = 2e-4;  // a pole at 5 kPa
  write_parameters(parameters);
  const auto outcome = run({"study.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("bar_inflation: the surrogate ends after 3 of 4 states"), std::string::npos) << outcome.out;
  const io::CsvContents summary = io::read_csv(folder_ / "out/summary.csv");
  std::size_t row = 0;
  while (summary.text(row, "kind") != "displacement" || summary.text(row, "range") != "outside") ++row;
  EXPECT_EQ(summary.number(row, "without_equilibrium"), 4.0) << "three extents and the top, at a pressure beyond the range";
}

/// Charts of one row, and of a surrogate without any: nothing of VTK's may reach the user.
TEST_F(ValidateProgram, DrawsACurveOfOneRow) {
  for (const double pressure_Pa : {3e3, 0.0}) {
    const std::string place = pressure_Pa > 0.0 ? "one" : "rest";
    write_curve(place, "bar_inflation", LoadCaseKind::inflation, {pressure_Pa}, {});
    const auto outcome = run({"study.toml", "--curves", place, "-o", place + "_out"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << pressure_Pa;
  }
  voxel::SurrogateParameters parameters = truth();
  parameters.validity.set_pressures(-5e3, 1e3);
  for (voxel::PressureLaw& law : parameters.extension) law.pressure_softening_per_Pa = 5e-4;  // a pole at 2 kPa
  write_parameters(parameters);
  const auto outcome = run({"study.toml", "--curves", "one", "-o", "none_out"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

TEST_F(ValidateProgram, SumsUpByHowTheSurrogateEnded) {
  voxel::SurrogateParameters parameters = truth();
  for (voxel::PressureLaw& law : parameters.bulge) law.slope_per_Pa = 2e-4;  // walls meet at -1.5 kPa: 0.6 of a cell between them
  write_parameters(parameters);
  const auto outcome = run({"study.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("(wall_contact, chamber walls across"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("wall_contact: 3 curves"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("not_converged"), std::string::npos) << outcome.out;
}

TEST_F(ValidateProgram, LeavesWithTwoAndWritesNothingOnBadInput) {
  const auto refuses = [&](const std::string& message) {
    const auto outcome = run({"study.toml", "-o", "out"});
    EXPECT_EQ(outcome.code, 2) << message;
    EXPECT_EQ(outcome.err.rfind("menger-validate: error: ", 0), 0U) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << message;
  };
  // curves of the fit whose provenance was edited since, and others with another name and at other pressures
  const auto fitted = [](const std::string& table_hash, const std::string& subject) {
    return "[fit]\n[[fit.curves]]\nname = 'x'\nhash = '0'\ntable_hash = '" + table_hash + "'\nsubject = '" + subject + "'\n";
  };
  const std::string provenance = io::read_whole(folder_ / "curves/bar_modes.toml");
  io::write_whole(folder_ / "curves/bar_modes.toml", provenance + "# edited\n");
  write_parameters(truth(), fitted(io::file_hash(folder_ / "curves/bar_modes.csv"), "another"));
  refuses("bar_modes.csv: content hash");
  write_parameters(truth(), fitted("0", "stretch of 3x1x1:111, level 1"));
  refuses("bar_stretch.toml: case = \"stretch of 3x1x1:111, level 1\": is not held out");
  write_parameters(truth(), fitted("0", "bending of 3x1x1:111, level 1"));
  EXPECT_EQ(run({"study.toml", "-o", "other", "--no-pictures"}).code, 0) << "without the curve of the fit nothing is refused";
  voxel::SurrogateParameters other = truth();
  other.law = "Ogden";
  write_parameters(other);
  refuses("law = \"neo-Hookean 86.7 kPa\": the parameters");
  write_parameters(truth());
  io::write_whole(folder_ / "study.toml", "parameters = 'parameters.toml'\ncurves = ['nowhere']\n");
  refuses("nowhere: does not exist");
  EXPECT_NE(run({"study.toml", "-o", "out", "--curves", "nofolder"}).err.find("nofolder: does not exist"), std::string::npos);
  io::write_whole(folder_ / "study.toml", "parameters = 'parameters.toml'\ncurves = ['curves']\nfolder = 1\n");
  refuses("folder");
  EXPECT_EQ(run({"absent.toml"}).code, 2);
}

TEST_F(ValidateProgram, MakesTheCurvesOfItsLoadCasesFirst) {
  // A script beside a copy of the program makes the curves by copying them.
  fs::create_directories(folder_ / "bin");
  fs::copy_file(MENGER_PROGRAM_DIR "/menger-validate", folder_ / "bin/menger-validate");
  const fs::path script = folder_ / "bin/menger-load-cases";
  const auto write_script = [&](int code) {
    io::write_whole(script, "#!/bin/sh\n[ \"$2\" = -o ] && mkdir -p \"$3\" && cp '" + (folder_ / "curves").string() +
                                "'/* \"$3\" && exit " + std::to_string(code) + "\nexit 1\n");
    fs::permissions(script, fs::perms::owner_all);
  };
  io::write_whole(folder_ / "set.toml", "");
  io::write_whole(folder_ / "study.toml", "parameters = 'parameters.toml'\nload_cases = 'set.toml'\n");
  const auto run_copy = [&] {
    return test_support::ProgramRun(folder_, folder_ / "bin/menger-validate", {"study.toml", "-o", "out", "--no-pictures"})
        .wait();
  };
  write_script(3);
  const auto early = run_copy();
  EXPECT_EQ(early.code, 0) << early.err << ": cases that ended early are told of by their curves";
  EXPECT_EQ(io::read_csv(folder_ / "out/volume_actuation.csv").row_count(), 1U);
  EXPECT_TRUE(fs::exists(folder_ / "out/curves/bar_modes.csv"));
  write_script(2);
  const auto refused = run_copy();
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("set.toml: menger-load-cases ended with exit code 2"), std::string::npos) << refused.err;
  write_script(130);
  EXPECT_EQ(run_copy().code, 130);
}

TEST_F(ValidateProgram, ExplainsItself) {
  const auto outcome = run({"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("Example:"), std::string::npos);
}

}  // namespace
}  // namespace menger
