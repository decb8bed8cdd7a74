#include "fem/pneumatics/pressure_schedule.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

const std::vector<std::string> plena{"plenum 0", "plenum 1"};

/// @param folder of the study, from which it counts paths
std::vector<PlenumSchedule> read(const std::string& text, const std::filesystem::path& folder = {}) {
  const io::TomlTable table = io::parse_toml(text, folder / "study.toml");
  return read_plenum_schedules(table.tables("pressure"), plena);
}

using tests::message_of;

TEST(PressureSchedule, SineStartsLowAndSwingsBetweenItsBounds) {
  const PlenumSchedule sine{SinePressure{.low_Pa = -1e3, .high_Pa = 5e3, .frequency_Hz = 2.0}};
  EXPECT_DOUBLE_EQ(pressure_Pa(sine, 0.0), -1e3);
  EXPECT_DOUBLE_EQ(pressure_Pa(sine, 0.25), 5e3);
  EXPECT_NEAR(pressure_Pa(sine, 0.125), 2e3, 1e-9);
  EXPECT_NEAR(pressure_Pa(sine, 0.6), pressure_Pa(sine, 0.1), 1e-9);
}

TEST(PressureSchedule, SquareRisesAndFallsInStraightLines) {
  const PlenumSchedule square{
      SquarePressure{.low_Pa = 1.0, .high_Pa = 3.0, .frequency_Hz = 1.0, .phase = 0.0, .duty = 0.4, .rise_s = 0.1}};
  EXPECT_DOUBLE_EQ(pressure_Pa(square, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(pressure_Pa(square, 0.05), 2.0);
  EXPECT_DOUBLE_EQ(pressure_Pa(square, 0.3), 3.0);
  EXPECT_NEAR(pressure_Pa(square, 0.45), 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(pressure_Pa(square, 0.8), 1.0);
  const PlenumSchedule edged{SquarePressure{.low_Pa = 0.0, .high_Pa = 1.0, .frequency_Hz = 1.0, .phase = 0.5}};
  EXPECT_EQ(pressure_Pa(edged, 0.0), 0.0);
  EXPECT_EQ(pressure_Pa(edged, 0.5), 1.0);
}

TEST(PressureSchedule, TableIsInterpolatedAndHeldAtItsEnds) {
  const PlenumSchedule table{PressureTable{{1.0, 2.0, 4.0}, {10.0, 20.0, 0.0}}};
  EXPECT_EQ(pressure_Pa(table, 0.0), 10.0);
  EXPECT_EQ(pressure_Pa(table, 1.5), 15.0);
  EXPECT_EQ(pressure_Pa(table, 3.0), 10.0);
  EXPECT_EQ(pressure_Pa(table, 9.0), 0.0);
}

TEST(PressureSchedule, RampFadesIn) {
  const PlenumSchedule constant{ConstantPressure{6e3}, 0.2};
  EXPECT_EQ(pressure_Pa(constant, 0.0), 0.0);
  EXPECT_EQ(pressure_Pa(constant, 0.05), 1.5e3);
  EXPECT_EQ(pressure_Pa(constant, 0.2), 6e3);
  EXPECT_EQ(pressure_Pa(constant, 1.0), 6e3);
}

TEST(PressureSchedule, FilesGiveOneSchedulePerPlenum) {
  const auto schedules =
      read("[[pressure]]\nplenum = 'plenum 1'\nschedule = 'sine'\nhigh_Pa = 6e3\nfrequency_Hz = 3\nramp_s = 0.1\n");
  ASSERT_EQ(schedules.size(), 2U);
  EXPECT_EQ(pressure_Pa(schedules[0], 7.0), 0.0);
  EXPECT_NEAR(pressure_Pa(schedules[1], 0.5), 6e3, 1e-9);
  EXPECT_EQ(schedules[1].ramp_s, 0.1);
}

TEST(PressureSchedule, TablesComeFromCsv) {
  const tests::TestFolder folder;
  io::write_whole(folder / "schedule.csv", "time_s,pressure_Pa\n0,0\n0.5,4000\n");
  const auto schedules = read("[[pressure]]\nplenum = 'plenum 0'\nschedule = 'table'\nfile = 'schedule.csv'\n", folder);
  EXPECT_NEAR(pressure_Pa(schedules[0], 0.25), 2e3, 1e-9);
}

TEST(PressureSchedule, TimeMustNotRunBackwards) {
  const tests::TestFolder folder;
  const auto file = folder / "backwards.csv";
  io::write_whole(file, "time_s,pressure_Pa\n0,0\n0.5,4000\n0.4,0\n");
  const std::string message = message_of([&] { read_pressure_table(file); });
  EXPECT_NE(message.find("backwards.csv:4"), std::string::npos) << message;
  EXPECT_NE(message.find("0.4"), std::string::npos) << message;
  io::write_whole(file, "time_s,pressure_Pa\n");
  EXPECT_NE(message_of([&] { read_pressure_table(file); }), "no error");
}

TEST(PressureSchedule, BadInputNamesKeyAndValue) {
  const std::string sine = "schedule = 'sine'\nhigh_Pa = 6e3\nfrequency_Hz = 3\n";
  const auto message = [&](const std::string& text) { return message_of([&] { read(text); }); };
  EXPECT_NE(message("[[pressure]]\nplenum = 'lung'\n" + sine).find("\"plenum 0\", \"plenum 1\""), std::string::npos);
  const std::string twice = "[[pressure]]\nplenum = 'plenum 0'\n" + sine;
  EXPECT_NE(message(twice + twice).find("has a schedule already"), std::string::npos);
  EXPECT_NE(
      message("[[pressure]]\nplenum = 'plenum 0'\nschedule = 'sine'\nhigh_Pa = 6e3\nfrequency_Hz = 0\n").find("frequency_Hz"),
      std::string::npos);
  EXPECT_NE(message("[[pressure]]\nplenum = 'plenum 0'\nschedule = 'square'\nhigh_Pa = 1\nfrequency_Hz = 2\nrise_s = 0.3\n")
                .find("rise_s"),
            std::string::npos);
  EXPECT_NE(message("[[pressure]]\nplenum = 'plenum 0'\nschedule = 'saw'\n").find("schedule"), std::string::npos);
}

TEST(PressureSchedule, StepsMustResolveIt) {
  const std::vector<PlenumSchedule> schedules{{ConstantPressure{1.0}}, {SinePressure{.high_Pa = 1.0, .frequency_Hz = 100.0}}};
  EXPECT_EQ(message_of([&] { check_resolved(schedules, plena, 4e-4); }), "no error");
  EXPECT_NE(message_of([&] { check_resolved(schedules, plena, 6e-4); }).find("plenum \"plenum 1\": a period of 0.01 s"),
            std::string::npos);
  const auto message = [&](const PlenumSchedule& schedule, double step) {
    return message_of([&] { check_resolved(std::vector<PlenumSchedule>{schedule}, plena, step); });
  };
  const PlenumSchedule square{SquarePressure{.high_Pa = 1.0, .frequency_Hz = 1.0, .rise_s = 1e-3}};
  EXPECT_EQ(message(square, 4e-4), "no error");
  EXPECT_NE(message(square, 6e-4).find("a rise of 0.001 s"), std::string::npos);
  const PlenumSchedule table{PressureTable{{0.0, 1e-3, 1.0}, {0.0, 1.0, 0.0}}};
  EXPECT_EQ(message(table, 4e-4), "no error");
  EXPECT_NE(message(table, 6e-4).find("a line of a table of 0.001"), std::string::npos) << message(table, 6e-4);
  EXPECT_NE(message({ConstantPressure{1.0}, 1e-3}, 6e-4).find("a ramp of 0.001 s"), std::string::npos);
}

}  // namespace
}  // namespace menger::fem
