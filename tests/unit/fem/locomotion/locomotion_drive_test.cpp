#include "fem/locomotion/locomotion_drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "io/study/study_reader.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"

namespace menger::fem {
namespace {

using tests::message_of;

/// Two cells side by side along x of materials 1 and 2.
meshes::Design pair_design() { return {"pair", meshes::Polycube::from_digits(2, 1, 1, "12"), 0.01}; }

std::vector<PlenumSchedule> schedules_of(const std::string& keys, meshes::ChamberLayout chambers, int level = 1) {
  const meshes::Design design = pair_design();
  meshes::HollowBodyOptions hollow;
  hollow.chambers = chambers;
  hollow.level = level;
  const meshes::HexahedralMesh mesh = meshes::hollow_polycube(design, hollow).mesh;
  const io::TomlTable table = io::parse_toml(keys, "drive.toml");
  SurrogateDrive drive;
  io::read_described(table, drive);
  return plenum_schedules(drive, design, hollow, mesh);
}

// The formula is that of the surrogate's pressure drive, written down from its description.
TEST(SurrogateDrive, GivesThePressureOfTheSurrogate) {
  const double low = -500.0;
  const double high = 6000.0;
  const double period_s = 0.2;
  const auto schedules = schedules_of(
      "pressure_Pa = [-500, 6000]\nmode = \"antiphase\"\nfrequency_Hz = 5\n"
      "material_phase = [0.1, 0.6]\nramp_s = 0.3\n",
      meshes::ChamberLayout::per_phase);
  ASSERT_EQ(schedules.size(), 2U);
  for (const double time_s : {0.0, 0.013, 0.11, 0.299, 0.3, 0.41, 7.77}) {
    for (std::size_t p = 0; p < 2; ++p) {
      const double phase = p == 0 ? 0.1 : 0.6;
      const double ramp = std::min(1.0, time_s / 0.3);
      const double sine = std::sin(2.0 * std::numbers::pi * (time_s / period_s + phase));
      const double expected = ramp * (0.5 * (low + high) + 0.5 * (high - low) * sine);
      EXPECT_NEAR(pressure_Pa(schedules[p], time_s), expected, 1e-9 * high) << "plenum " << p << " at " << time_s;
    }
  }
}

TEST(SurrogateDrive, GrowsOverItsFirstPeriodUnlessToldOtherwise) {
  const auto schedules =
      schedules_of("pressure_Pa = [0, 6000]\nmode = \"in_phase\"\nfrequency_Hz = 4\n", meshes::ChamberLayout::single);
  ASSERT_EQ(schedules.size(), 1U);
  EXPECT_EQ(schedules[0].ramp_s, 0.25);
}

TEST(SurrogateDrive, HoldsTheHighestPressureOrNone) {
  const auto held = schedules_of("pressure_Pa = [0, 6000]\nmode = \"hold\"\nfrequency_Hz = 2\n", meshes::ChamberLayout::single);
  EXPECT_DOUBLE_EQ(pressure_Pa(held[0], 0.25), 3000.0);
  EXPECT_EQ(pressure_Pa(held[0], 2.0), 6000.0);
  const auto none = schedules_of("pressure_Pa = [0, 6000]\nmode = \"none\"\n", meshes::ChamberLayout::single);
  EXPECT_EQ(pressure_Pa(none[0], 2.0), 0.0);
}

// Modules of an aggregate along x: cells 0 and 1 are the first module. A wave of one period per two cells gives both the phases
// of their cells, which one chamber cannot have; per phase each cell is a chamber of its own.
TEST(SurrogateDrive, RefusesPhasesThatSharedAirCannotHave) {
  const std::string antiphase = "pressure_Pa = [0, 6000]\nmode = \"antiphase\"\nfrequency_Hz = 5\n";
  const std::string message = message_of([&] { (void)schedules_of(antiphase, meshes::ChamberLayout::single); });
  EXPECT_NE(message.find("drive.mode: cells (0, 0, 0) and (1, 0, 0) share the air of \"plenum 0\""), std::string::npos)
      << message;
  EXPECT_EQ(message_of([&] { (void)schedules_of(antiphase, meshes::ChamberLayout::per_phase); }), "no error");
  const std::string wave = "pressure_Pa = [0, 6000]\nmode = \"wave\"\nwave_axis = \"x\"\nfrequency_Hz = 5\n";
  EXPECT_NE(message_of([&] { (void)schedules_of(wave, meshes::ChamberLayout::single); }).find("share the air"),
            std::string::npos);
}

// Cells 0 to 3 along x of a level-2 body with phases -i / 4: each per-phase chamber is one cell.
TEST(SurrogateDrive, GivesAWaveThePhasesOfTheGrid) {
  const auto schedules =
      schedules_of("pressure_Pa = [0, 1000]\nmode = \"wave\"\nwave_axis = \"x\"\nfrequency_Hz = 1\nramp_s = 0\n",
                   meshes::ChamberLayout::per_phase, 2);
  ASSERT_EQ(schedules.size(), 4U);
  for (std::size_t cell = 0; cell < 4; ++cell) {
    const double expected = 500.0 * (1.0 + std::sin(2.0 * std::numbers::pi * (0.1 - 0.25 * static_cast<double>(cell))));
    EXPECT_NEAR(pressure_Pa(schedules[cell], 0.1), expected, 1e-9);
  }
}

TEST(SurrogateDrive, RefusesWhatIsNoDrive) {
  const auto message = [](const std::string& keys) {
    return message_of([&] { (void)schedules_of(keys, meshes::ChamberLayout::single); });
  };
  const std::string mode = "mode = \"in_phase\"\n";
  EXPECT_NE(message("pressure_Pa = [6000, 0]\nfrequency_Hz = 1\n" + mode).find("must ascend"), std::string::npos);
  EXPECT_NE(message("pressure_Pa = [0]\nfrequency_Hz = 1\n" + mode).find("must be two numbers, not 1"), std::string::npos);
  EXPECT_NE(message("pressure_Pa = [-2e5, 0]\nfrequency_Hz = 1\n" + mode).find("perfect vacuum"), std::string::npos);
  EXPECT_NE(message("pressure_Pa = [0, 1]\nfrequency_Hz = 0\n" + mode).find("frequency_Hz = 0"), std::string::npos);
  EXPECT_NE(message("pressure_Pa = [0, 1]\nperiod_s = 0.5\n" + mode).find("period_s = 0.5: is called frequency_Hz now"),
            std::string::npos);
  EXPECT_NE(message("pressure_Pa = [0, 1]\n" + mode).find("frequency_Hz is missing"), std::string::npos);
  EXPECT_NE(message("pressure_Pa = [0, 1]\nfrequency_Hz = 1\nwave_axis = \"x\"\n" + mode).find("belongs to mode = \"wave\""),
            std::string::npos);
  EXPECT_NE(message("pressure_Pa = [0, 1]\nfrequency_Hz = 1\nmode = \"phased\"\n").find("mode = \"phased\""), std::string::npos);
}

TEST(SurrogateDrive, TemplateAndTextsAreRead) {
  const auto parse = [](const std::string& text) {
    SurrogateDrive drive;
    io::read_described(io::parse_toml(text, "drive.toml"), drive);
    return drive;
  };
  tests::expect_template_is_read<SurrogateDrive>(parse);
  tests::expect_texts_are_read_back<SurrogateDrive>(parse);
}

}  // namespace
}  // namespace menger::fem
