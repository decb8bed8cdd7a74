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
                    "[element]\ndegree = 1\n[supports]\nkind = \"ground_held\"\n[path]\npressure_Pa = [0, 2000]\n");
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
