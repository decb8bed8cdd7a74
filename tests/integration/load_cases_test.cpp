#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "io/text/whole_file.h"
#include "meshes/load_cases/response_curve.h"
#include "tests/support/copied_program.h"
#include "tests/support/paraview_files.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"
#include "tests/support/two_processes.h"
#include "tests/support/wait_until.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;

/// The program in a folder of its own, with sets of cases of a cell in 26 linear elements.
class LoadCasesProgram : public testing::Test {
 protected:
  void write_set(const std::string& cases) const {
    io::write_whole(folder_ / "set.toml",
                    "silicone = \"dragon_skin_10\"\n[body]\ncell_edge_m = 0.01\nwall_thickness_m = 0.002\n"
                    "[elements]\ndegree = 1\nlargest_element_m = 0.006\ngrowth = 4\n" +
                        cases);
  }

  /// Returns the text of a case of one cell. @param lines further keys
  static std::string cell(const std::string& name, const std::string& kind, const std::string& lines) {
    return "[[case]]\nname = \"" + name + "\"\nkind = \"" + kind + "\"\ncells = [1, 1, 1]\ndigits = \"1\"\n" + lines;
  }

  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    return ProgramRun(folder_, MENGER_PROGRAM_DIR "/menger-load-cases", std::move(arguments)).wait();
  }

  const tests::TestFolder folder_;
};

const std::string stretch = "pressures_Pa = [0, 2000]\ndisplacement_m = [0.0005, 0.001]\n";

TEST_F(LoadCasesProgram, WritesCurvesWithProvenancePicturesAndManifest) {
  write_set(cell("pull", "stretch", stretch) + cell("hold", "blocked", "pressures_Pa = [-500, 1000]\n"));
  const Outcome outcome = run({"set.toml", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const meshes::ResponseCurve pull = meshes::read_response_curve(folder_ / "out/pull.toml");
  EXPECT_EQ(pull.row_count(), 4U);
  EXPECT_EQ(pull.provenance.silicone, "Dragon Skin 10");
  EXPECT_EQ(pull.provenance.inputs.size(), 2U);
  EXPECT_EQ(meshes::read_response_curve(folder_ / "out/hold.toml").row_count(), 2U);
  EXPECT_TRUE(fs::exists(folder_ / "out/manifest.json"));
  EXPECT_NE(outcome.out.find("pull"), std::string::npos);
  EXPECT_NE(fs::exists(folder_ / "out/pull.png"), outcome.out.find("no picture: ") != std::string::npos) << outcome.out;
  const Outcome again = run({"set.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.out.find("from the cache"), std::string::npos) << again.out;
  EXPECT_FALSE(fs::exists(folder_ / "out/pull.png")) << "it might be of an earlier curve";
}

TEST_F(LoadCasesProgram, OnTwoRanksGivesWhatOneProcessGives) {
  write_set(cell("pull", "stretch", stretch) + cell("hold", "blocked", "pressures_Pa = [-500, 1000]\n") +
            cell("crush", "stretch", "pressures_Pa = [0]\ndisplacement_m = [-0.0099, 0.0005]\n"));
  ASSERT_EQ(run({"set.toml", "-o", "alone", "--no-pictures"}).code, 3);
  const auto on_ranks = [&] {
    return test_support::start_two_processes(folder_, MENGER_PROGRAM_DIR "/menger-load-cases",
                                             {"set.toml", "-o", "out", "--no-pictures"})
        .wait();
  };
  const Outcome outcome = on_ranks();
  ASSERT_EQ(outcome.code, 3) << outcome.err << outcome.out;
  EXPECT_NE(outcome.out.find("3 cases on 2 processes"), std::string::npos) << outcome.out;
  for (const char* file : {"pull.csv", "pull.toml", "hold.csv", "hold.toml", "crush.csv", "crush.toml"})
    EXPECT_EQ(io::read_whole(folder_ / "out" / file), io::read_whole(folder_ / "alone" / file)) << file;
  // All curves were made by the ranks.
  std::size_t found = 0;
  for (std::size_t at = outcome.out.find("from the cache"); at != std::string::npos;
       at = outcome.out.find("from the cache", at + 1))
    ++found;
  EXPECT_EQ(found, 3U) << outcome.out;
  EXPECT_EQ(outcome.out.find("each process did from 0 "), std::string::npos) << "both ranks had cases: " << outcome.out;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/cache")) EXPECT_NE(entry.path().extension(), ".out");
}

/// Ranks whose cases are computed by a script in place of the program. It writes where its output goes to, and then waits for a
/// file `go_on`.
class LoadCasesOfAScript : public LoadCasesProgram {
 protected:
  LoadCasesOfAScript() {
    write_set(cell("pull", "stretch", stretch) + cell("hold", "blocked", "pressures_Pa = [-500, 1000]\n"));
    test_support::copy_program(MENGER_PROGRAM_DIR "/menger-load-cases", folder_, "ranks");
    const std::string script =
        "#!/bin/sh\ncase \"$*\" in *--only*) ;; *) exit 0 ;; esac\ncd '" + folder_.path().string() +
        "'\nout=$(readlink /proc/$$/fd/1)\necho \"$out\" >begun.$$\nwhile [ ! -e go_on ]; do sleep 0.02; done\n";
    io::write_whole(folder_ / "bin/menger-load-cases", script);
    fs::permissions(folder_ / "bin/menger-load-cases", fs::perms::owner_exec, fs::perm_options::add);
  }

  /// Returns the files of output of all programs of cases that have begun, in order.
  [[nodiscard]] std::vector<std::string> begun() const {
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (!entry.path().filename().string().starts_with("begun.")) continue;
      const std::string line = io::read_whole(entry.path());
      if (line.ends_with('\n')) files.push_back(fs::path(line.substr(0, line.size() - 1)).filename());
    }
    std::ranges::sort(files);
    return files;
  }

  [[nodiscard]] ProgramRun start(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"set.toml", "-o", "out", "--no-pictures", "--rank-patience", "0.5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test_support::start_two_processes(folder_, folder_ / "bin/ranks", std::move(arguments));
  }
};

TEST_F(LoadCasesOfAScript, HaveOutputOfTheirOwnOnEachRank) {
  const ProgramRun run = start({});
  ASSERT_TRUE(test_support::wait_until([&] { return begun().size() == 2; }));
  const std::vector<std::string> files = begun();
  EXPECT_EQ(files[0].find("hold.rank_1_of_"), 0U) << files[0];
  EXPECT_EQ(files[1].find("pull.rank_0_of_"), 0U) << files[1];
  io::write_whole(folder_ / "go_on", "");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(LoadCasesOfAScript, AreNotComputedTwiceAtOnceIfTheirFieldsAreKept) {
  const ProgramRun run = start({"--fields"});
  ASSERT_TRUE(test_support::wait_until([&] { return begun().size() == 2; }));
  const pid_t rank = test_support::ranks_of(run).at(1);
  kill(rank, SIGSTOP);
  ASSERT_TRUE(test_support::wait_until([&] { return run.printed().find("has been silent") != std::string::npos; }));
  io::write_whole(folder_ / "go_on", "");
  // The first rank has nothing but the case of the other one to do now.
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_EQ(begun().size(), 2U);
  kill(rank, SIGCONT);
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(LoadCasesProgram, OnRanksSaysWhatIsWrongWithTheSet) {
  write_set(cell("pull", "stretch", stretch) + "depth = 3\n");
  const Outcome outcome =
      test_support::start_two_processes(folder_, MENGER_PROGRAM_DIR "/menger-load-cases", {"set.toml", "-o", "out"}).wait();
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("depth"), std::string::npos) << outcome.err;
}

TEST_F(LoadCasesProgram, LeavesNoEarlierCurveOfACaseThatReachesNothing) {
  write_set(cell("pull", "stretch", stretch));
  ASSERT_EQ(run({"set.toml", "-o", "out"}).code, 0);
  ASSERT_TRUE(fs::exists(folder_ / "out/pull.toml"));
  write_set(cell("pull", "stretch", "pressures_Pa = [0]\ndisplacement_m = [-0.0099]\n"));
  const Outcome outcome = run({"set.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  for (const char* extension : {".toml", ".csv", ".png"})
    EXPECT_FALSE(fs::exists(folder_ / (std::string("out/pull") + extension))) << extension;
  EXPECT_NE(outcome.out.find("removed"), std::string::npos) << outcome.out;
}

TEST_F(LoadCasesProgram, GoesOnAfterACaseThatEndsEarlyAndSaysSo) {
  write_set(cell("crush", "stretch", "pressures_Pa = [0]\ndisplacement_m = [-0.0099, 0.0005]\n") +
            cell("pull", "stretch", stretch));
  const Outcome outcome = run({"set.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(outcome.code, 3) << outcome.out;
  EXPECT_NE(meshes::read_response_curve(folder_ / "out/crush.toml").provenance.status, io::RunStatus::completed);
  EXPECT_EQ(meshes::read_response_curve(folder_ / "out/pull.toml").provenance.status, io::RunStatus::completed);
  EXPECT_EQ(run({"set.toml", "-o", "out", "--no-pictures"}).code, 3) << "also from the cache";
}

TEST_F(LoadCasesProgram, RefusesWrongInputAndWritesNothing) {
  write_set(cell("pull", "stretch", stretch + "displacment_m = 1\n"));
  const Outcome unknown = run({"set.toml", "-o", "out"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("set.toml"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("displacment_m"), std::string::npos) << unknown.err;
  write_set(cell("pull", "stretch", stretch));
  const Outcome name = run({"set.toml", "-o", "out", "--only", "push"});
  EXPECT_EQ(name.code, 2);
  EXPECT_NE(name.err.find("--only push"), std::string::npos) << name.err;
  EXPECT_EQ(run({"missing.toml"}).code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(LoadCasesProgram, BodyThatDoesNotFitIntoMemoryIsRefusedBeforeAnyCaseIsComputed) {
  write_set(cell("pull", "stretch", stretch) +
            cell("fine", "stretch", stretch + "element_kind = \"three_field\"\ndegree = 2\nthrough_wall = 10\n"));
  const std::string limited = "ulimit -d 3000000; exec '" MENGER_PROGRAM_DIR "/menger-load-cases' set.toml -o out";
  const Outcome outcome = ProgramRun(folder_, "/bin/sh", {"-c", limited}).wait();
  EXPECT_EQ(outcome.code, 2) << outcome.err << outcome.out;
  for (const char* words : {"load case \"fine\"", "unknowns of", "GB of memory", "through_wall = 10"})
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(LoadCasesProgram, ComputesOnlyTheCasesThatAreNamed) {
  write_set(cell("pull", "stretch", stretch) + cell("hold", "blocked", "pressures_Pa = [1000]\n"));
  ASSERT_EQ(run({"set.toml", "-o", "out", "--only", "hold", "--no-pictures"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/hold.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "out/pull.csv"));
}

TEST_F(LoadCasesProgram, KeepsFieldsOfCachedCasesOnlyWhenAsked) {
  write_set(cell("inflate", "inflation", "pressures_Pa = [-500, 0, 2000]\n"));
  const fs::path collection = folder_ / "out/fields/inflate/fields.pvd";
  ASSERT_EQ(run({"set.toml", "-o", "out", "--no-pictures"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/fields"));
  const std::string curve = io::read_whole(folder_ / "out/inflate.csv");
  const Outcome computed = run({"set.toml", "-o", "out", "--no-pictures", "--fields"});
  ASSERT_EQ(computed.code, 0) << computed.err;
  EXPECT_EQ(computed.out.find("from the cache"), std::string::npos) << computed.out;
  EXPECT_EQ(io::read_whole(folder_ / "out/inflate.csv"), curve) << "the same curve again";
  const std::string steps = io::read_whole(collection);
  std::size_t earlier = 0;
  for (const char* file : {"fields/step_0000.vtu", "fields/step_0001.vtu", "fields/step_0002.vtu"}) {
    EXPECT_TRUE(fs::exists(collection.parent_path() / file)) << file;
    const std::size_t at = steps.find(file);
    ASSERT_NE(at, std::string::npos) << file;
    EXPECT_GT(at, earlier) << "in the order of the rows";
    earlier = at;
  }
  test_support::expect_opens_in_paraview(folder_ / "out");
  for (const std::vector<std::string>& fields : {std::vector<std::string>{}, {"--fields"}}) {
    std::vector<std::string> arguments{"set.toml", "-o", "out", "--no-pictures"};
    arguments.insert(arguments.end(), fields.begin(), fields.end());
    EXPECT_NE(run(arguments).out.find("from the cache"), std::string::npos);
    EXPECT_EQ(io::read_whole(collection), steps);
  }
}

// Half of a chamber's pressure is in its thin walls: stresses without it are 1000 Pa off.
TEST_F(LoadCasesProgram, FieldsOfThinWallsHaveTheStressOfMengerInflate) {
  const std::string elements = "[elements]\nkind = \"thin_wall\"\nfidelity = \"draft\"\n";
  io::write_whole(folder_ / "set.toml", "silicone = \"dragon_skin_10\"\n[body]\ncell_edge_m = 0.01\nwall_thickness_m = 0.002\n" +
                                            elements + cell("inflate", "inflation", "pressures_Pa = [0, 2000]\n"));
  io::write_whole(folder_ / "cube.toml", "name = \"cube\"\ncell_edge_m = 0.01\nlayers = [[\"1\"]]\n");
  io::write_whole(folder_ / "study.toml", elements +
                                              "[design]\nfile = \"cube.toml\"\nwall_thickness_m = 0.002\n"
                                              "[material]\nsilicone = \"dragon_skin_10\"\n[supports]\nkind = \"free\"\n"
                                              "[path]\npressure_Pa = [0, 2000]\nfirst_step = 0.5\nlargest_step = 0.5\n"
                                              "[output]\npictures = false\n");
  ASSERT_EQ(run({"set.toml", "-o", "out", "--no-pictures", "--fields"}).code, 0);
  ASSERT_EQ(ProgramRun(folder_, MENGER_PROGRAM_DIR "/menger-inflate", {"study.toml", "-o", "inflated"}).wait().code, 0);
  const auto read = [&](vtkXMLUnstructuredGridReader& reader, const std::string& file) {
    reader.SetFileName((folder_ / file).c_str());
    reader.Update();
    return reader.GetOutput();
  };
  vtkNew<vtkXMLUnstructuredGridReader> of_case;
  vtkNew<vtkXMLUnstructuredGridReader> of_inflate;
  vtkUnstructuredGrid* const here = read(*of_case, "out/fields/inflate/fields/step_0001.vtu");
  vtkUnstructuredGrid* const there = read(*of_inflate, "inflated/fields/step_0002.vtu");
  vtkDataArray* const stress = here->GetPointData()->GetArray("cauchy_stress_Pa");
  vtkDataArray* const expected = there->GetPointData()->GetArray("cauchy_stress_Pa");
  ASSERT_TRUE(stress != nullptr && expected != nullptr);
  ASSERT_EQ(here->GetNumberOfPoints(), there->GetNumberOfPoints());
  for (vtkIdType n = 0; n < here->GetNumberOfPoints(); ++n)
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(stress->GetComponent(n, c), expected->GetComponent(n, c), 1.0) << n << " " << c;
}

TEST_F(LoadCasesProgram, KeepsFinishedCasesWhenInterrupted) {
  write_set(cell("pull", "stretch", stretch) +
            "[[case]]\nname = \"long\"\nkind = \"inflation\"\ncells = [3, 3, 1]\n"
            "digits = \"111111111\"\ndegree = 2\nthrough_wall = 2\n");
  const ProgramRun program(folder_, MENGER_PROGRAM_DIR "/menger-load-cases", {"set.toml", "-o", "out", "--no-pictures"});
  ASSERT_TRUE(test_support::wait_until([&] { return fs::exists(folder_ / "out/pull.toml"); }));
  program.send(SIGINT);
  const Outcome stopped = program.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.out << stopped.err;
  EXPECT_FALSE(fs::exists(folder_ / "out/long.csv"));
  write_set(cell("pull", "stretch", stretch));
  const Outcome again = run({"set.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.out.find("from the cache"), std::string::npos) << again.out;
}

}  // namespace
}  // namespace menger
