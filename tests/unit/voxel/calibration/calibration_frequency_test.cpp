#include "voxel/calibration/calibration_frequency.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::voxel {
namespace {

SurrogateParameters bar_parameters() {
  SurrogateParameters p;
  p.cell_edge_m = 0.01;
  p.wall_thickness_m = 0.002;
  p.density_kg_m3 = 1000.0;
  p.axial_Pa.fill(150e3);
  p.bending_Pa.fill(150e3);
  p.torsion_Pa.fill(150e3);
  p.extension.fill({.slope_per_Pa = 2e-6});
  p.bulge.fill({.slope_per_Pa = 5e-7});
  p.bulge_peak_ratio.fill(2.0);
  p.ground_stiffness_N_per_m = 1000.0;
  return p;
}

meshes::LoadCase bar(int length) {
  meshes::LoadCase body;
  body.cells = {length, 1, 1};
  body.digits = std::string(static_cast<std::size_t>(length), '1');
  return body;
}

TEST(CalibrationFrequency, SlowMotionIsTheStaticExtension) {
  // Each cell of 1 cm grows by 2e-6 per Pa, and the middle of the end wall bulges by 2 * 5e-7 on top.
  const auto gains = harmonic_gains(bar_parameters(), bar(3), 0.0, BodyEnd::tip, std::array{0.0});
  ASSERT_TRUE(gains[0]);
  // the slope of the pressure load is a difference, to seven digits
  EXPECT_NEAR(*gains[0], 3.0 * 0.01 * 2e-6 + 0.01 * 2.0 * 5e-7, 1e-6 * *gains[0]);
}

TEST(CalibrationFrequency, OneCellAnswersLikeAnOscillator) {
  // One mass on half a beam, whose rest length follows the pressure: the centre moves by u = u0 / (1 - (omega / omega0)^2) with
  // u0 = (L / 2) a and omega0^2 = (EA / (L / 2)) / m; the other half and the bulge follow the pressure at once.
  const SurrogateParameters p = bar_parameters();
  const double mass_kg = 1000.0 * (1e-6 - 0.006 * 0.006 * 0.006);
  const double omega0 = std::sqrt(150e3 * 1e-4 / 0.005 / mass_kg);
  const std::array frequencies{0.5, 5.0, 0.5 * omega0 / (2.0 * std::numbers::pi)};
  const auto gains = harmonic_gains(p, bar(1), 0.0, BodyEnd::top, frequencies);
  for (std::size_t n = 0; n < frequencies.size(); ++n) {
    const double ratio = 2.0 * std::numbers::pi * frequencies[n] / omega0;
    const double expected = 0.005 * 2e-6 / (1.0 - ratio * ratio) + 0.005 * 2e-6 + 0.01 * 2.0 * 5e-7;
    ASSERT_TRUE(gains[n]);
    EXPECT_NEAR(*gains[n], expected, 1e-6 * expected);
  }
}

TEST(CalibrationFrequency, ReadsGainsAndComplexAmplitudes) {
  const tests::TestFolder folder;
  const std::filesystem::path file = folder / "response.csv";
  io::write_whole(file, "frequency_Hz,tip_x_real_m_per_Pa,tip_x_imaginary_m_per_Pa\n0.5,3e-8,-4e-8\n1,,\n");
  FrequencyReference reference{.file = file, .column = "tip_x", .body = bar(3)};
  auto gains = read_frequency_gains(reference);
  compute_frequency_response(gains, reference, bar_parameters());
  ASSERT_EQ(gains.size(), 1U) << "the reference has none at its resonance";
  EXPECT_NEAR(gains[0].reference_m_per_Pa, 5e-8, 1e-20);
  EXPECT_TRUE(gains[0].surrogate_m_per_Pa);
  reference.column.clear();
  EXPECT_THROW((void)read_frequency_gains(reference), io::InputError);
}

}  // namespace
}  // namespace menger::voxel
