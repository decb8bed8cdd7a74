#include "fem/pneumatics/pressure_schedule.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "fem/pneumatics/pressure_schedule_file.h"
#include "io/study/study_reader.h"
#include "io/study/study_text.h"
#include "io/text/whole_file.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

const std::vector<std::string> two_plena{"plenum 0", "plenum 1"};

/// A schedule in a table of its own.
struct StudySchedule {
  PlenumSchedule schedule;
  std::optional<std::filesystem::path> file{};
};

void describe(io::StudyVisitor& visitor, StudySchedule& study) { describe(visitor, study.schedule, study.file); }

/// @param folder of the study, from which it counts paths
StudySchedule read_schedule(const std::string& text, const std::filesystem::path& folder = {}) {
  StudySchedule schedule;
  io::read_described(io::parse_toml(text, folder / "study.toml"), schedule);
  return schedule;
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

TEST(PressureSchedule, FilesGiveItsMembers) {
  const PlenumSchedule sine = read_schedule("schedule = 'sine'\nhigh_Pa = 6e3\nfrequency_Hz = 3\nramp_s = 0.1\n").schedule;
  EXPECT_NEAR(pressure_Pa(sine, 0.5), 6e3, 1e-9);
  EXPECT_EQ(sine.ramp_s, 0.1);
  const PlenumSchedule square =
      read_schedule("schedule = 'square'\nlow_Pa = 1\nhigh_Pa = 3\nfrequency_Hz = 1\nduty = 0.4\nrise_s = 0.1\nphase = 0.05\n")
          .schedule;
  EXPECT_DOUBLE_EQ(pressure_Pa(square, 0.0), 2.0);
}

TEST(PressureSchedule, TablesComeFromCsvOrStandInTheStudy) {
  const tests::TestFolder folder;
  io::write_whole(folder / "schedule.csv", "time_s,pressure_Pa\n0,0\n0.5,4000\n");
  const StudySchedule study = read_schedule("schedule = 'table'\nfile = 'schedule.csv'\n", folder);
  EXPECT_NEAR(pressure_Pa(study.schedule, 0.25), 2e3, 1e-9);
  EXPECT_EQ(study.file, folder / "schedule.csv");
  const std::string text = io::described_text(study);
  EXPECT_EQ(text, "schedule = \"table\"\ntimes_s = [0, 0.5]\npressures_Pa = [0, 4000]\nramp_s = 0\n");
  EXPECT_EQ(io::described_text(read_schedule(text)), text);
  EXPECT_FALSE(read_schedule(text).file);
}

TEST(PressureSchedule, TemplateAndTextsAreRead) {
  const auto parse = [](const std::string& text) { return read_schedule(text); };
  tests::expect_template_is_read<StudySchedule>(parse);
  tests::expect_texts_are_read_back<StudySchedule>(parse);
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
  for (const auto& [text, part] : std::initializer_list<std::pair<const char*, const char*>>{
           {"schedule = 'sine'\nhigh_Pa = 6e3\nfrequency_Hz = 0\n", "frequency_Hz = 0"},
           {"schedule = 'sine'\nhigh_Pa = 6e3\n", "frequency_Hz is missing"},
           {"schedule = 'square'\nhigh_Pa = 1\nfrequency_Hz = 2\nrise_s = 0.375\n", "rise_s = 0.375: must not be longer"},
           {"schedule = 'saw'\n", "schedule = \"saw\""},
           {"pressure_Pa = 1\n", "schedule is missing"},
           {"schedule = 'table'\n", "times_s or file is missing"},
           {"schedule = 'table'\ntimes_s = [0, 1]\npressures_Pa = [0]\n",
            "pressures_Pa = [0]: must have as many values as times_s"},
           {"schedule = 'table'\ntimes_s = [0, 1, 1]\npressures_Pa = [0, 1, 2]\n", "times_s[3] = 1: must be later"}}) {
    const std::string message = message_of([&, keys = std::string(text)] { (void)read_schedule(keys); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(PressureSchedule, StepsMustResolveIt) {
  const std::vector<PlenumSchedule> schedules{{ConstantPressure{1.0}}, {SinePressure{.high_Pa = 1.0, .frequency_Hz = 100.0}}};
  EXPECT_EQ(message_of([&] { check_resolved(schedules, two_plena, 4e-4); }), "no error");
  EXPECT_NE(message_of([&] { check_resolved(schedules, two_plena, 6e-4); }).find("plenum \"plenum 1\": a period of 0.01 s"),
            std::string::npos);
  const auto message = [&](const PlenumSchedule& schedule, double step) {
    return message_of([&] { check_resolved(std::vector<PlenumSchedule>{schedule}, two_plena, step); });
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
