#include "voxel/model/surrogate_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/text/input_error.h"
#include "tests/support/described_study.h"
#include "tests/support/test_folder.h"

namespace menger::voxel {
namespace {

SurrogateParameters example() {
  SurrogateParameters p;
  p.silicone = "dragon-skin-10";
  p.law = "ogden \"3\"";
  p.cell_edge_m = 0.01;
  p.wall_thickness_m = 0.002;
  p.voxels_per_cell = 2;
  p.chambers = meshes::ChamberLayout::per_phase;
  p.validity = {.smallest_strain = -0.2, .largest_strain = 0.3, .longest_body_cells = 3, .longest_aggregate_modules = 2};
  p.validity.set_pressures(-3e3, 6e3);
  p.density_kg_m3 = 1070.0;
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    const auto k = static_cast<double>(c);
    p.axial_Pa[c] = 1e4 / 3.0 + k;
    p.bending_Pa[c] = 2e4 / 3.0 + k;
    p.torsion_Pa[c] = 3e4 / 3.0 + k;
    p.shear_compliance_per_Pa[c] = 1e-5 / 3.0 + 1e-6 * k;
    p.extension[c] = {1e-6 / 3.0 + 1e-7 * k, 1e-5 * k, -2e-5 * k, 0.1 * k, 1e-4 / 3.0 * k};
    p.bulge[c] = {2e-6 / 3.0 + 1e-7 * k, -1e-5 * k, 3e-5 * k};
  }
  p.joint = {.axial = 1.1, .bending = 0.9, .torsion = 0.7};
  p.lateral_coupling = 0.4;
  p.bulge_peak_ratio.fill(2.1);
  p.neck_ratio = 1.7;
  p.elbow_ratio = 2.3;
  p.plate_stretch_ratio = 3.3;
  p.plate_draw_in = 0.11;
  p.plate_rise = 0.07;
  p.plate_draw_in_per_Pa = 4e-4 / 3.0;
  p.plate_edge_share = 0.12;
  p.plate_arm_ratio = 1.3;
  p.wide_volume_ratio = 1.09;
  p.ground_stiffness_N_per_m = 512.0 / 3.0;
  p.bond_damping_ratio = 0.2;
  p.damping_measured = true;
  return p;
}

class SurrogateFile : public testing::Test {
 protected:
  SurrogateParameters read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_surrogate(file_);
  }
  /// The message of the error that a text with one part replaced gives.
  std::string fault(const std::string& part, const std::string& by) {
    std::string text = surrogate_text(example());
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    text.replace(at, part.size(), by);
    try {
      read(text);
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "no error";
  }

  const tests::TestFolder folder_;
  const std::filesystem::path file_ = folder_ / "surrogate.toml";
};

TEST_F(SurrogateFile, ReadsBackWhatItWrote) { EXPECT_EQ(read(surrogate_text(example())), example()); }

TEST_F(SurrogateFile, ReadsTheDensityOfEarlierVersions) {
  std::string text = surrogate_text(example());
  const std::string key = "density_kg_per_m3";
  text.replace(text.find(key), key.size(), "density_kg_m3");
  EXPECT_EQ(read(text), example());
}

TEST_F(SurrogateFile, TemplateIsReadToItsExamples) {
  tests::expect_template_is_read<SurrogateParameters>([this](const std::string& text) { return read(text); });
}

TEST_F(SurrogateFile, TakesBeamsWithoutAShearComplianceForStiff) {
  const std::string text = surrogate_text(example());
  const std::size_t begin = text.find("shear_compliance_per_Pa");
  ASSERT_NE(begin, std::string::npos);
  SurrogateParameters expected = example();
  expected.shear_compliance_per_Pa.fill(0.0);
  EXPECT_EQ(read(std::string(text).erase(begin, text.find('\n', begin) + 1 - begin)), expected);
}

TEST_F(SurrogateFile, JudgesTheLawOfAWallClassOverItsOwnRange) {
  SurrogateParameters one = example();
  one.voxels_per_cell = 1;
  one.validity.highest_pressure_Pa[0] = 1e6;  // of which class no law has a pole
  EXPECT_EQ(read(surrogate_text(one)), one);
  one.validity.highest_pressure_Pa[1] = 0.99e5;  // the extension of class 1 has its pole at 1e5 Pa
  EXPECT_EQ(read(surrogate_text(one)), one);
  one.validity.highest_pressure_Pa[1] = 1.01e5;
  EXPECT_THROW(read(surrogate_text(one)), io::InputError);
  one.validity.highest_pressure_Pa[1] = 6e3;
  one.voxels_per_cell = 2;  // voxels of a cell of class 0 may be of class 1
  EXPECT_THROW(read(surrogate_text(one)), io::InputError);
}

TEST_F(SurrogateFile, LeavesTheReportOfTheFitUnread) {
  const std::string report = "[fit]\nresidual = 0.1\n[fit.case]\nname = \"blocked\"\n[[fit.rows]]\nx = [1, 2]\n";
  EXPECT_EQ(read(surrogate_text(example()) + report), example());
}

/// A report may say anything, but a number that is none there tells of a fit that failed.
TEST_F(SurrogateFile, RefusesNumbersThatAreNoneAnywhere) {
  const auto message = [&](const std::string& report) -> std::string {
    try {
      read(surrogate_text(example()) + report);
    } catch (const io::InputError& error) {
      return error.what();
    }
    return {};
  };
  for (const auto& [report, expected] :
       {std::pair{"[fit.confidence_95]\naxial_Pa = [-nan, 2.0]\n", "fit.confidence_95.axial_Pa[1] = "},
        std::pair{"[fit]\nchi2 = inf\n", "fit.chi2 = inf: must be a finite number"},
        std::pair{"[[fit.curves]]\nname = \"a\"\nrms = nan\n", "fit.curves[1].rms = nan: must be a finite number"},
        std::pair{"[fit]\nat_bound = [\"axial_Pa\"]\n[fit.confidence_95]\naxial_Pa = [1.0, 2.0]\n",
                  "fit.confidence_95.axial_Pa = [1.0, 2.0]: must be \"not determined\""}}) {
    const std::string found = message(report);
    EXPECT_NE(found.find(expected), std::string::npos) << found;
    EXPECT_NE(found.find("surrogate.toml:"), std::string::npos) << found;
  }
  EXPECT_EQ(message("[fit]\nat_bound = [\"axial_Pa\", \"torsion_Pa\"]\n[fit.confidence_95]\naxial_Pa = \"not determined\"\n"
                    "bending_Pa = [1.0, 2.0]\n"),
            "");
}

TEST_F(SurrogateFile, NamesWhatIsWrong) {
  const auto expect = [&](const std::string& part, const std::string& by, const std::string& message) {
    const std::string found = fault(part, by);
    EXPECT_NE(found.find(message), std::string::npos) << found;
    EXPECT_NE(found.find("surrogate.toml"), std::string::npos) << found;
  };
  expect("cell_edge_m = 0.01", "cell_edge_m = -0.01", "holds_for.cell_edge_m = -0.01: must be > 0");
  expect("cell_edge_m = 0.01", "cell_edge_mm = 10", "cell_edge_m");
  expect("[mass]\n", "[mass]\nvolume_m3 = 1\n", "mass.volume_m3");
  expect("[mass]\n", "[extra]\n[mass]\n", "extra");
  expect("wall_thickness_m = 0.002", "wall_thickness_m = 0.005", "must be less than half of cell_edge_m");
  expect("shear_compliance_per_Pa = [", "shear_compliance_per_Pa = [-1e-9, ", "must be >= 0");
  expect("lateral_coupling = 0.4", "lateral_coupling = 1", "must be in [0, 1)");
  expect("peak_ratio = [2.1", "peak_ratio = [0.5", "must be >= 1");
  expect("neck_ratio = 1.7", "neck_ratio = 0", "must be > 0");
  expect("elbow_ratio = 2.3", "elbow_ratio = -1", "must be >= 0");
  expect("plate_stretch_ratio = 3.3", "plate_stretch_ratio = 0", "must be > 0");
  expect("plate_draw_in = 0.11", "plate_draw_in = 1", "must be in [0, 1)");
  expect("plate_rise = 0.07", "plate_rise = -0.07", "must be >= 0");
  expect("plate_draw_in_per_Pa = ", "plate_draw_in_per_Pa = -", "must be >= 0");
  expect("plate_edge_share = 0.12", "plate_edge_share = 1.1", "must be in [0, 1]");
  expect("plate_arm_ratio = 1.3", "plate_arm_ratio = 0", "must be > 0");
  expect("wide_volume_ratio = 1.09", "wide_volume_ratio = -1", "must be > 0");
  expect("plate_stretch_ratio = 3.3", "plate_stretch_ratio = 1e4", "the rest length of voxels inside a plate is not positive at");
  expect("axial_Pa = [", "axial_Pa = [1, ", "must be 7 numbers, not 8");
  expect("highest_pressure_Pa = [6000", "highest_pressure_Pa = [1e6", "has its pole within the range of validity");
  expect("lowest_pressure_gap_2_Pa = [-3000, ", "lowest_pressure_gap_2_Pa = [", "must be 7 numbers, not 6");
  expect("lowest_pressure_gap_1_Pa = [-3000", "lowest_pressure_gap_1_Pa = [3000",
         "validity.lowest_pressure_gap_1_Pa[1] = 3000: must be <= 0");
  expect("highest_joint_pressure_Pa = 6000", "highest_joint_pressure_Pa = -1",
         "validity.highest_joint_pressure_Pa = -1: must be");
  expect("slope_per_Pa = [3", "slope_per_Pa = [3000, 3", "must be 7 numbers");
}

}  // namespace
}  // namespace menger::voxel
