#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "io/text/csv_table.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "tests/support/paraview_files.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"
#include "tests/support/two_processes.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;

/// The program in a folder of its own, with studies of a hollow cube of 98 elements.
class LocomoteProgram : public testing::Test {
 protected:
  LocomoteProgram() {
    io::write_whole(folder_ / "design.toml", "name = \"cube\"\ncell_edge_m = 0.02\nlayers = [[\"1\"]]\n");
    write_study("study.toml", "0.05", "");
  }

  void write_study(const std::string& name, const std::string& duration_s, const std::string& more) const {
    io::write_whole(folder_ / name,
                    "[design]\nfile = \"design.toml\"\nwall_thickness_m = 0.004\n"
                    "[material]\nsilicone = \"dragon_skin_10\"\nbulk_modulus_ratio = 20\n"
                    "[ground]\nstatic_friction = 1\nkinetic_friction = 0.5\n"
                    "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 4000]\nfrequency_Hz = 20\n"
                    "[time]\nduration_s = " +
                        duration_s + "\n" + more);
  }

  [[nodiscard]] ProgramRun start(std::vector<std::string> arguments) const {
    return {folder_, MENGER_PROGRAM_DIR "/menger-locomote", std::move(arguments)};
  }
  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const { return start(std::move(arguments)).wait(); }

  /// Starts the program on two processes.
  [[nodiscard]] ProgramRun start_parallel(std::vector<std::string> arguments) const {
    return test_support::start_two_processes(folder_, MENGER_PROGRAM_DIR "/menger-locomote", std::move(arguments));
  }
  [[nodiscard]] Outcome run_parallel(std::vector<std::string> arguments) const {
    return start_parallel(std::move(arguments)).wait();
  }

  /// Sends Ctrl-C as soon as a file exists.
  [[nodiscard]] Outcome interrupted_after(const ProgramRun& program, const std::string& file) const {
    for (int n = 0; n < 60000 && !fs::exists(folder_ / file); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_TRUE(fs::exists(folder_ / file));
    program.send(SIGINT);
    return program.wait();
  }

  const tests::TestFolder folder_;
};

TEST_F(LocomoteProgram, WritesWhatItPromises) {
  const Outcome outcome = run({"study.toml", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("damping is not measured"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("completed: 0.05 s"), std::string::npos) << outcome.out;
  for (const char* name : {"trajectory.csv", "frames.pvd", "frames/frame_0000.vtu", "manifest.json"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  test_support::expect_opens_in_paraview(folder_ / "out");
  const io::TomlTable result = io::read_toml(folder_ / "out/locomotion.toml");
  EXPECT_EQ(result.text("status"), "completed");
  EXPECT_EQ(result.numbers("displacement_m").size(), 3U);
  for (const char* key : {"body_length_m", "body_lengths_per_minute", "peak_height_m", "seconds"})
    EXPECT_GE(result.number(key), 0.0) << key;
  const io::CsvContents trajectory = io::read_csv(folder_ / "out/trajectory.csv");
  EXPECT_EQ(trajectory.number(0, "time_s"), 0.0);
  EXPECT_EQ(trajectory.number(trajectory.row_count() - 1, "time_s"), 0.05);
  const std::string manifest = io::read_whole(folder_ / "out/manifest.json");
  EXPECT_NE(manifest.find("not measured"), std::string::npos);
  EXPECT_NE(manifest.find("design.toml"), std::string::npos);
}

TEST_F(LocomoteProgram, IsQuietIfToldTo) {
  const Outcome outcome = run({"study.toml", "-o", "out", "--quiet", "--no-pictures"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
  EXPECT_FALSE(fs::exists(folder_ / "out/robot.png"));
}

TEST_F(LocomoteProgram, GoesOnAfterCtrlC) {
  write_study("long.toml", "0.4", "[output]\npictures = false\n");
  ASSERT_EQ(run({"long.toml", "-o", "whole"}).code, 0);
  // The run takes about a second. Its first frame shows that it is running.
  const Outcome outcome = interrupted_after(start({"long.toml", "-o", "parts"}), "parts/frames/frame_0001.vtu");
  ASSERT_EQ(outcome.code, 130) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("stopped"), std::string::npos) << outcome.out;
  EXPECT_EQ(io::read_toml(folder_ / "parts/locomotion.toml").text("status"), "stopped");
  ASSERT_EQ(run({"long.toml", "-o", "parts"}).code, 0);
  EXPECT_EQ(io::read_whole(folder_ / "parts/trajectory.csv"), io::read_whole(folder_ / "whole/trajectory.csv"));
  EXPECT_EQ(io::read_whole(folder_ / "parts/frames.pvd"), io::read_whole(folder_ / "whole/frames.pvd"));
}

// Implicit dynamics writes the same files. It has a program of its own, which this one starts.
TEST_F(LocomoteProgram, MovesBodiesImplicitly) {
  write_study("implicit.toml", "0.1",
              "record_interval_s = 0.005\n[dynamics]\nmethod = \"implicit\"\n[output]\npictures = false\n");
  ASSERT_EQ(run({"implicit.toml", "-o", "whole"}).code, 0);
  const io::TomlTable result = io::read_toml(folder_ / "whole/locomotion.toml");
  EXPECT_EQ(result.text("status"), "completed");
  EXPECT_EQ(io::read_csv(folder_ / "whole/trajectory.csv").row_count(), 21U);
  EXPECT_TRUE(fs::exists(folder_ / "whole/manifest.json"));

  const Outcome outcome = interrupted_after(start({"implicit.toml", "-o", "parts"}), "parts/frames/frame_0001.vtu");
  ASSERT_EQ(outcome.code, 130) << outcome.out << outcome.err;
  EXPECT_EQ(io::read_toml(folder_ / "parts/locomotion.toml").text("status"), "stopped");
  ASSERT_EQ(run({"implicit.toml", "-o", "parts"}).code, 0);
  EXPECT_EQ(io::read_whole(folder_ / "parts/trajectory.csv"), io::read_whole(folder_ / "whole/trajectory.csv"));
  EXPECT_EQ(io::read_whole(folder_ / "parts/frames.pvd"), io::read_whole(folder_ / "whole/frames.pvd"));
}

// An L, which leans and slides. Sums over two processes are rounded differently, and iterations end with a different residual.
// Positions may differ by the tolerance of Newton's method, 0.05 times 2e-5 of 57 mm.
TEST_F(LocomoteProgram, MovesABodyOnTwoProcessesAsOnOne) {
  io::write_whole(folder_ / "design.toml", "name = \"L\"\ncell_edge_m = 0.02\nlayers = [[\"11\"], [\"10\"]]\n");
  write_study("implicit.toml", "0.012",
              "record_interval_s = 0.001\n[dynamics]\nmethod = \"implicit\"\n[output]\npictures = false\n");
  ASSERT_EQ(run({"implicit.toml", "-o", "one"}).code, 0);
  const Outcome outcome = run_parallel({"implicit.toml", "-o", "two"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("completed: "), outcome.out.rfind("completed: ")) << "said once";
  const io::CsvContents one = io::read_csv(folder_ / "one/trajectory.csv");
  const io::CsvContents two = io::read_csv(folder_ / "two/trajectory.csv");
  ASSERT_EQ(two.row_count(), one.row_count());
  for (std::size_t row = 0; row < one.row_count(); ++row)
    for (const char* column : {"centre_of_mass_x_m", "centre_of_mass_y_m", "centre_of_mass_z_m"})
      EXPECT_NEAR(two.number(row, column), one.number(row, column), 6e-8) << row << column;
  EXPECT_GT(std::abs(one.number(one.row_count() - 1, "centre_of_mass_x_m") - one.number(0, "centre_of_mass_x_m")), 1e-5);
  for (const char* name : {"frames.pvd", "frames/frame_0001.vtu", "manifest.json", "locomotion.toml"})
    EXPECT_TRUE(fs::exists(folder_ / "two" / name)) << name;
  test_support::expect_opens_in_paraview(folder_ / "two");

  // Two processes do not repeat their finished run, and one process does not use the result of two.
  const std::string frame = io::read_whole(folder_ / "two/frames/frame_0001.vtu");
  ASSERT_EQ(run_parallel({"implicit.toml", "-o", "two"}).code, 0);
  EXPECT_EQ(io::read_whole(folder_ / "two/frames/frame_0001.vtu"), frame);
  const Outcome alone = run({"implicit.toml", "-o", "two"});
  EXPECT_EQ(alone.code, 2);
  EXPECT_NE(alone.err.find("belongs to another study"), std::string::npos) << alone.err;
  EXPECT_TRUE(fs::exists(folder_ / "two/trajectory.csv"));
}

// mpirun needs some seconds to pass Ctrl-C on, and ends with its own exit code.
TEST_F(LocomoteProgram, StopsOnTwoProcessesAndGoesOn) {
  write_study(
      "implicit.toml", "1000",
      "record_interval_s = 0.005\n[dynamics]\nmethod = \"implicit\"\n[output]\npictures = false\nrecords_per_frame = 1\n");
  const auto reached_s = [&] {
    const io::TomlTable result = io::read_toml(folder_ / "parts/locomotion.toml");
    EXPECT_EQ(result.text("status"), "stopped");
    return result.number("time_s");
  };
  const auto frame = [](int number) { return "frames/frame_" + std::to_string(10000 + number).substr(1) + ".vtu"; };
  EXPECT_NE(interrupted_after(start_parallel({"implicit.toml", "-o", "parts"}), "parts/" + frame(1)).code, 0);
  const double first_s = reached_s();
  EXPECT_GE(first_s, 0.005);
  const std::string kept = io::read_whole(folder_ / "parts" / frame(1));
  const int next = static_cast<int>(std::lround(first_s / 0.005)) + 1;  // rounded down, 1.18 / 0.005 is a frame that there is
  EXPECT_NE(interrupted_after(start_parallel({"implicit.toml", "-o", "parts"}), "parts/" + frame(next)).code, 0);
  EXPECT_GT(reached_s(), first_s);
  EXPECT_EQ(io::read_whole(folder_ / "parts" / frame(1)), kept);
}

TEST_F(LocomoteProgram, RefusesWhatSeveralProcessesCannotShare) {
  const Outcome outcome = run_parallel({"study.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("study.toml: explicit dynamics runs in one process, and 2 were started"), std::string::npos)
      << outcome.err;
  write_study("sweep.toml", "0.01",
              "[dynamics]\nmethod = \"implicit\"\n[sweep]\nkeys = [\"ground.kinetic_friction\"]\nvalues = [0.2, 0.4]\n");
  const Outcome sweep = run_parallel({"sweep.toml", "-o", "out"});
  EXPECT_EQ(sweep.code, 2);
  EXPECT_NE(sweep.err.find("sweep.toml: sweep: "), std::string::npos) << sweep.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(LocomoteProgram, BodyThatDoesNotFitIntoMemoryIsRefusedWithTheKeysThatDecideIt) {
  write_study("implicit.toml", "0.05", "[elements]\ndegree = 2\n[dynamics]\nmethod = \"implicit\"\n");
  std::string study = io::read_whole(folder_ / "implicit.toml");
  study.insert(study.find("[material]"), "elements_through_wall = 8\n");
  io::write_whole(folder_ / "implicit.toml", study);
  const std::string limited = "ulimit -d 3000000; exec '" MENGER_PROGRAM_DIR "/menger-locomote' implicit.toml -o out";
  const Outcome outcome = ProgramRun(folder_, "/bin/sh", {"-c", limited}).wait();
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  for (const char* words :
       {"implicit.toml: ", "unknowns of", "GB of memory", "elements.degree = 2", "design.elements_through_wall = 8"})
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(LocomoteProgram, RefusesWhatImplicitDynamicsHasNot) {
  write_study("implicit.toml", "0.05", "[dynamics]\nmethod = \"implicit\"\nself_contact = true\n");
  const Outcome outcome = run({"implicit.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("implicit.toml"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("dynamics.self_contact = true"), std::string::npos) << outcome.err;
  write_study("implicit.toml", "0.05", "[dynamics]\nmethod = \"implicit\"\n");
  const Outcome threads = run({"implicit.toml", "-o", "out", "--threads", "2"});
  EXPECT_EQ(threads.code, 2);
  EXPECT_NE(threads.err.find("--threads"), std::string::npos) << threads.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(LocomoteProgram, RunsTheCasesOfASweep) {
  write_study("sweep.toml", "0.01",
              "[output]\npictures = false\n[sweep]\nkeys = [\"ground.kinetic_friction\"]\nvalues = [0.2, 0.4]\n");
  const Outcome outcome = run({"sweep.toml", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 of 2, ground.kinetic_friction = 0.4"), std::string::npos) << outcome.out;
  const io::CsvContents table = io::read_csv(folder_ / "out/sweep.csv");
  ASSERT_EQ(table.row_count(), 2U);
  EXPECT_EQ(table.number(1, "ground.kinetic_friction"), 0.4);
  EXPECT_TRUE(fs::exists(folder_ / "out/case_02/locomotion.toml"));
}

TEST_F(LocomoteProgram, SaysHowABurstEnds) {
  write_study("burst.toml", "0.1", "[output]\npictures = false\n");
  std::string text = io::read_whole(folder_ / "burst.toml");
  text.replace(text.find("4000"), 4, "200e3");
  io::write_whole(folder_ / "burst.toml", text);
  const Outcome outcome = run({"burst.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.err;
  const io::TomlTable result = io::read_toml(folder_ / "out/locomotion.toml");
  EXPECT_NE(result.text("status"), "completed");
  EXPECT_NE(result.text("reason"), "");
  EXPECT_FALSE(result.has("displacement_m"));
}

TEST_F(LocomoteProgram, RefusesWrongInputAndTouchesNothing) {
  write_study("wrong.toml", "0.05", "[floor]\nstickiness = 1\n");
  const Outcome outcome = run({"wrong.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("menger-locomote: error: wrong.toml"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("floor"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(run({"no_such.toml"}).code, 2);
  EXPECT_EQ(run({"study.toml", "--threads", "0"}).code, 2);
}

TEST_F(LocomoteProgram, NamesTheDampingThatStepsCannotFollow) {
  std::string text = io::read_whole(folder_ / "study.toml");
  const std::string record = "silicone = \"dragon_skin_10\"\n";
  text.insert(text.find(record) + record.size(), "loss_factor = 0.1\nloss_frequency_Hz = 1e6\n");
  io::write_whole(folder_ / "fast.toml", text);
  const Outcome outcome = run({"fast.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("fast.toml: material.loss_frequency_Hz = 1e+06: a Maxwell branch relaxes within"), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(LocomoteProgram, ExplainsItselfWithAnExample) {
  const Outcome outcome = run({"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("menger locomote fem/studies/locomotion.toml -o walk"), std::string::npos);
}

TEST_F(LocomoteProgram, RunsItsTemplate) {
  const Outcome outcome = run({"--template"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  io::write_whole(folder_ / "template.toml", outcome.out);
  const Outcome walk = run({"template.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(walk.code, 0) << walk.err;
  EXPECT_NE(walk.out.find("completed: 0.1 s"), std::string::npos) << walk.out;
  EXPECT_NE(run({"--keys"}).out.find("ground.static_friction"), std::string::npos);
  EXPECT_NE(run({"--schema"}).out.find("\"static_friction\""), std::string::npos);
}

TEST_F(LocomoteProgram, LoadsNoFiniteElementLibraries) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen("ldd '" MENGER_PROGRAM_DIR "/menger-locomote'", "r"), pclose);
  std::string libraries;
  for (int sign = fgetc(pipe.get()); sign != EOF; sign = fgetc(pipe.get())) libraries += static_cast<char>(sign);
  EXPECT_NE(libraries.find("libstdc++"), std::string::npos) << libraries;
  for (const char* library : {"libdeal", "libpetsc", "libslepc"})
    EXPECT_EQ(libraries.find(library), std::string::npos) << library;
}

}  // namespace
}  // namespace menger
