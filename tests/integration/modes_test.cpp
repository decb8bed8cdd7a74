#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "io/text/whole_file.h"
#include "tests/support/paraview_files.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;

/// The program in a folder of its own, with a study of a hollow cube of 98 linear elements.
class ModesProgram : public testing::Test {
 protected:
  ModesProgram() {
    io::write_whole(folder_ / "cube_design.toml", "name = \"cube\"\ncell_edge_m = 0.02\nlayers = [[\"1\"]]\n");
    io::write_whole(folder_ / "study.toml",
                    "[design]\nfile = \"cube_design.toml\"\nwall_thickness_m = 0.004\n"
                    "[material]\nbulk_modulus_Pa = 2.5e6\ndensity_kg_per_m3 = 1070\n"
                    "law = {name = \"neo_hookean\", shear_modulus_Pa = 5e4}\n"
                    "[elements]\ndegree = 1\n[supports]\nkind = \"ground_held\"\n[path]\npressure_Pa = [0, 2000]\n");
  }

  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    return ProgramRun(folder_, MENGER_PROGRAM_DIR "/menger-modes", std::move(arguments)).wait();
  }

  const tests::TestFolder folder_;
};

TEST_F(ModesProgram, WritesFrequenciesAtTheKnotsOfThePathAndTheResponse) {
  const Outcome outcome = run({"study.toml", "-o", "out", "--count", "2", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents modes = io::read_csv(folder_ / "out/modes.csv");
  ASSERT_EQ(modes.row_count(), 4U) << "two modes of two states";
  for (std::size_t row = 0; row < 4; ++row) EXPECT_GT(modes.number(row, "frequency_Hz"), 0.0);
  const io::CsvContents response = io::read_csv(folder_ / "out/frequency_response.csv");
  EXPECT_EQ(response.number(0, "frequency_Hz"), 0.5);
  EXPECT_TRUE(fs::exists(folder_ / "out/result.toml"));
  EXPECT_TRUE(fs::exists(folder_ / "out/manifest.json"));
  test_support::expect_opens_in_paraview(folder_ / "out");
}

// At 0.5 Hz, a hundredth of the first natural frequency, the response is the slope of the volume and of points over the pressure
// to 1e-4. The difference of volumes at pressures 2 % apart errs by the curvature of the curve, some 1e-4, too.
TEST_F(ModesProgram, RespondsOnThinWallsAsReportedVolumesAndPointsDo) {
  const auto study = [&](const std::string& pressures_Pa) {
    return "[elements]\nkind = \"thin_wall\"\n"
           "[design]\nfile = \"cube_design.toml\"\nwall_thickness_m = 0.004\n"
           "[material]\nbulk_modulus_Pa = 2.5e6\ndensity_kg_per_m3 = 1070\n"
           "law = {name = \"neo_hookean\", shear_modulus_Pa = 5e4}\n"
           "[supports]\nkind = \"ground_held\"\n[path]\npressure_Pa = " +
           pressures_Pa + "\n[output]\nfields = false\npictures = false\n";
  };
  io::write_whole(folder_ / "modes.toml", study("[0, 2000]"));
  io::write_whole(folder_ / "inflate.toml", study("[0, 1980, 2020]"));
  const Outcome outcome = run({"modes.toml", "-o", "out", "--count", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(io::read_whole(folder_ / "out/manifest.json").find("thin_wall"), std::string::npos);
  EXPECT_NE(io::read_whole(folder_ / "out/manifest.json").find("standard"), std::string::npos);
  ASSERT_EQ(ProgramRun(folder_, MENGER_PROGRAM_DIR "/menger-inflate", {"inflate.toml", "-o", "inflated"}).wait().code, 0);
  const io::CsvContents curve = io::read_csv(folder_ / "inflated/curves.csv");
  const auto value_at = [&](double pressure_Pa, const std::string& column) {
    for (std::size_t row = 0; row < curve.row_count(); ++row)
      if (curve.number(row, "plenum_0_pressure_Pa") == pressure_Pa) return curve.number(row, column);
    return 0.0;
  };
  const io::CsvContents response = io::read_csv(folder_ / "out/frequency_response.csv");
  const auto expect_slope = [&](const std::string& column, const std::string& of) {
    const double slope = (value_at(2020.0, of) - value_at(1980.0, of)) / 40.0;
    EXPECT_GT(slope, 0.0);
    EXPECT_NEAR(response.number(0, column), slope, 1e-3 * slope) << column;
  };
  expect_slope("chamber_volume_real_m3_per_Pa", "plenum_0_volume_m3");
  expect_slope("top_centre_z_real_m_per_Pa", "top_centre_displacement_z_m");
}

// At a limit point ends the study's path, and not the one to a pressure that is asked for instead.
TEST_F(ModesProgram, ReachesAPressureOfAStudyThatEndsAtItsLimitPoint) {
  std::string study = io::read_whole(folder_ / "study.toml");
  study.replace(study.find("pressure_Pa = [0, 2000]"), 23,
                "volume_ratio = [1, 40]\nend_at_limit_point = true\nfirst_step = 0.005\nlargest_step = 0.01");
  io::write_whole(folder_ / "limit.toml", study);
  const Outcome whole = run({"limit.toml", "-o", "whole", "--count", "1", "--no-pictures"});
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(io::read_csv(folder_ / "whole/modes.csv").row_count(), 1U) << "at rest";
  EXPECT_NE(io::read_whole(folder_ / "whole/result.toml").find("no state beyond has modes"), std::string::npos);
  const Outcome beyond = run({"limit.toml", "-o", "beyond", "--count", "1", "--no-pictures", "--pressure", "1e6"});
  EXPECT_EQ(beyond.code, 3) << beyond.out << beyond.err;
  const Outcome before = run({"limit.toml", "-o", "before", "--count", "1", "--no-pictures", "--pressure", "2000"});
  EXPECT_EQ(before.code, 0) << before.err;
  EXPECT_EQ(io::read_csv(folder_ / "before/modes.csv").row_count(), 1U);
}

// A comparison with nan is false, so a range alone would accept it.
TEST_F(ModesProgram, RefusesNumbersThatAreNone) {
  for (const char* option : {"--loss-factor", "--pressure"}) {
    for (const char* value : {"nan", "inf"}) {
      const Outcome outcome = run({"study.toml", "-o", "out", option, value});
      EXPECT_EQ(outcome.code, 2) << option << ' ' << value;
      EXPECT_NE(outcome.err.find(option), std::string::npos) << outcome.err;
      EXPECT_FALSE(fs::exists(folder_ / "out"));
    }
  }
}

}  // namespace
}  // namespace menger
