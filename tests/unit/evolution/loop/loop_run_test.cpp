#include "evolution/loop/loop_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "evolution/loop/loop_state.h"
#include "evolution/loop/loop_verdict_file.h"
#include "io/process/exit_code.h"
#include "io/process/file_lock.h"
#include "io/study/installed_folders.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr const char* robot_text = R"([robot]
name = "bar"
layers = [["1111"]]
cell_edge_m = 0.01
silicone = "dragon_skin_10"
)";

/// A folder with a robot, and with programs that stand in for those of menger: each notes its call in calls.txt, writes a
/// manifest into the folder that it is told to write to, and ends with the exit code in the file codes/NAME, if there is one.
class LoopRunTest : public testing::Test {
 protected:
  LoopRunTest() {
    io::write_whole(folder_ / "robot.toml", robot_text);
    fs::create_directories(folder_ / "codes");
    for (const char* name :
         {"mesh", "inflate", "load-cases", "calibrate", "validate", "simulate", "locomote", "evolve", "export", "reevaluate"})
      write_program(name, "");
  }

  /// @param more what else it does, in bash
  void write_program(const std::string& name, const std::string& more) const {
    const std::string text = "#!/bin/bash\necho " + name + " \"$@\" >> '" + (folder_ / "calls.txt").string() + "'\n" +
                             "out=; for ((i = 1; i <= $#; i++)); do [ \"${!i}\" = -o ] && j=$((i + 1)) && out=${!j}; done\n"
                             "case $out in *.vtu | *.sqlite) mkdir -p ${out%/*}; echo {} > ${out%.*}_manifest.json; echo {} > "
                             "${out%.*}.manifest.json ;;\n"
                             "*) mkdir -p $out; echo {} > $out/manifest.json ;; esac\n" +
                             more + "\nexit $(cat '" + (folder_ / "codes" / name).string() + "' 2>/dev/null || echo 0)\n";
    const fs::path file = folder_ / "bin" / ("menger-" + name);
    io::write_whole(file, text);
    fs::permissions(file, fs::perms::owner_all);
  }

  void end_with(const std::string& name, int code) const { io::write_whole(folder_ / "codes" / name, std::to_string(code)); }

  int run(const std::string& until = "", const std::string& only = "") {
    out_.str("");
    fs::remove(folder_ / "calls.txt");
    LoopRequest request{
        .robot = folder_ / "robot.toml", .until = until, .only = only, .programs = folder_ / "bin", .stop = &stop_};
    return run_loop(request, out_);
  }

  /// The commands that the last run called.
  [[nodiscard]] std::vector<std::string> calls() const {
    std::vector<std::string> names;
    if (!fs::exists(folder_ / "calls.txt")) return names;
    std::istringstream lines(io::read_whole(folder_ / "calls.txt"));
    for (std::string line; std::getline(lines, line);) names.push_back(line);
    return names;
  }

  [[nodiscard]] std::vector<std::string> called() const {
    std::vector<std::string> names;
    for (const std::string& call : calls()) names.push_back(call.substr(0, call.find(' ')));
    return names;
  }

  void change(const std::string& from, const std::string& to) const {
    std::string text = io::read_whole(folder_ / "robot.toml");
    text.replace(text.find(from), from.size(), to);
    io::write_whole(folder_ / "robot.toml", text);
  }

  void add(const std::string& text) const {
    io::write_whole(folder_ / "robot.toml", io::read_whole(folder_ / "robot.toml") + text);
  }

  using Names = std::vector<std::string>;

  /// Manifests of an earlier robot, as the report is told.
  [[nodiscard]] Names left_behind() const {
    Names manifests;
    const LoopVerdict verdict = read_loop_verdict(folder_ / "results").value();
    for (const auto& [manifest, hash] : verdict.left_behind) manifests.push_back(manifest);
    return manifests;
  }

  tests::TestFolder folder_;
  std::ostringstream out_;
  std::atomic<bool> stop_{false};
};

const std::vector<std::string> all_of_bar{"mesh", "inflate", "inflate", "validate", "simulate", "locomote", "locomote"};

TEST_F(LoopRunTest, SecondRunDoesNothing) {
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), all_of_bar);
  EXPECT_TRUE(fs::exists(folder_ / "results/manifest.json"));
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), Names{});
  EXPECT_NE(out_.str().find("7 of 7  locomote_finer  as before"), std::string::npos) << out_.str();
}

TEST_F(LoopRunTest, ChangedNameRunsNothing) {
  ASSERT_EQ(run(), io::exit_code::done);
  change("name = \"bar\"", "name = \"beam\"");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), Names{});
}

TEST_F(LoopRunTest, ChangedKeyRunsOnlyWhatDependsOnIt) {
  ASSERT_EQ(run(), io::exit_code::done);
  add("[ground]\nkinetic_friction = 0.4\n");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"simulate", "locomote", "locomote"}));
  add("[drive]\npressure_Pa = [0, 5000]\n");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"inflate", "validate", "simulate", "locomote", "locomote"}));
  change("\"1111\"", "\"11\"");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), all_of_bar);
}

TEST_F(LoopRunTest, StageThatIsAsBeforeIsComparedWithTheDriveAsItIsNow) {
  write_program("inflate",
                R"(printf 'status = "completed"\n[[limit_points]]\nplenum = "plenum 0"\npressure_Pa = 8000\n' > $out/result.toml
echo step,plenum_0_volume_m3 > $out/curves.csv)");
  ASSERT_EQ(run("limit"), io::exit_code::done);
  EXPECT_NE(out_.str().find(
                "it balloons at 8 kPa by these elements, which put it 1 to 12 % too high; the drive of 6 kPa is 75 % of that"),
            std::string::npos)
      << out_.str();
  add("[drive]\npressure_Pa = [0, 7000]\n");
  ASSERT_EQ(run("limit"), io::exit_code::done);
  EXPECT_EQ(called(), Names{"inflate"});  // only the inflation up to the drive's pressure
  EXPECT_NE(out_.str().find("; the drive of 7 kPa is 88 % of that"), std::string::npos) << out_.str();
}

TEST_F(LoopRunTest, RefusedBodyIsTriedOnce) {
  write_program("mesh", "echo 'menger-mesh: error: cells touch along an edge only' >&2");
  write_program("report", "echo page > report.html");
  end_with("mesh", io::exit_code::bad_input);
  EXPECT_EQ(run(), io::exit_code::bad_input);
  EXPECT_EQ(called(), Names{"mesh"});
  EXPECT_NE(out_.str().find("2 of 8  inflate         left out: mesh refused the body"), std::string::npos) << out_.str();
  end_with("mesh", io::exit_code::done);
  EXPECT_EQ(run("locomote_finer"), io::exit_code::done);
  EXPECT_EQ(called(), all_of_bar);
}

/// What menger inflate writes of a body that balloons at 8 kPa, if it is to bear more.
constexpr const char* balloons_at_8_kPa = R"(
head='status = "completed"\n'; [[ $out = inflate ]] && grep -q 'pressure_Pa = .*9000' $1 && head='status = "limit_point"\n' && code=3
printf "$head[[limit_points]]\nplenum = \"plenum 0\"\npressure_Pa = 8000\n" > $out/result.toml
echo step,plenum_0_volume_m3 > $out/curves.csv
[[ $code ]] && exit 3)";

TEST_F(LoopRunTest, WhatTheBodyDoesNotBearIsNotWalkedWith) {
  write_program("inflate", balloons_at_8_kPa);
  ASSERT_EQ(run(), io::exit_code::done) << out_.str();
  EXPECT_EQ(called(), all_of_bar);
  add("[drive]\npressure_Pa = [0, 9000]\n");
  EXPECT_EQ(run(), io::exit_code::numerical);
  EXPECT_EQ(called(), Names{"inflate"});
  EXPECT_NE(out_.str().find("locomote        left out: it balloons at 8 kPa, before the 9 kPa of drive.pressure_Pa"),
            std::string::npos)
      << out_.str();
  EXPECT_NE(out_.str().find("lower drive.pressure_Pa to 5710 Pa or less"), std::string::npos) << out_.str();
  // No report may take the walk of the former drive for one of this drive.
  EXPECT_FALSE(fs::exists(folder_ / "results/locomote/manifest.json"));
  EXPECT_EQ(run("", "locomote"), io::exit_code::done);  // who asks for it gets it
  EXPECT_EQ(called(), Names{"locomote"});
}

TEST_F(LoopRunTest, UntilAStageTheReportIsToldWhatIsOfAnEarlierRobot) {
  ASSERT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(run("limit"), io::exit_code::done);
  EXPECT_EQ(left_behind(), Names{});
  add("[drive]\npressure_Pa = [0, 2000]\n");
  EXPECT_EQ(run("limit"), io::exit_code::done);
  EXPECT_EQ(left_behind(), (Names{"locomote/manifest.json", "locomote_finer/manifest.json", "simulate/manifest.json",
                                  "validate/manifest.json"}));
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(run("limit"), io::exit_code::done);
  EXPECT_EQ(left_behind(), Names{});
}

TEST_F(LoopRunTest, StageThatWasStoppedOrFailedLeavesNothingThatAReportShows) {
  for (const int code : {io::exit_code::interrupted, io::exit_code::bad_input, 1}) {
    end_with("simulate", code);  // its manifest is written all the same
    EXPECT_EQ(run("simulate"), code);
    EXPECT_FALSE(fs::exists(folder_ / "results/simulate/manifest.json")) << code;
    EXPECT_TRUE(fs::exists(folder_ / "results/inflate/manifest.json"));
  }
  end_with("simulate", io::exit_code::numerical);  // that is a result
  EXPECT_EQ(run("simulate"), io::exit_code::numerical);
  EXPECT_TRUE(fs::exists(folder_ / "results/simulate/manifest.json"));
}

TEST_F(LoopRunTest, BodyOfTheFitIsNotValidated) {
  change("\"1111\"", "\"111\"");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"mesh", "inflate", "inflate", "simulate", "locomote", "locomote"}));
}

TEST_F(LoopRunTest, ChangedProgramOrMissingResultRunsAgain) {
  ASSERT_EQ(run(), io::exit_code::done);
  write_program("simulate", "# another version");
  fs::remove(folder_ / "results/mesh/mesh_manifest.json");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"mesh", "simulate"}));
  write_program("load-cases", "# another version");  // which menger validate runs
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"validate"}));
  io::write_whole(folder_ / "results/validate/manifest.json", "of another run\n");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"validate"}));
}

TEST_F(LoopRunTest, TakesTheResultsOfTheSameCommandByHand) {
  write_program("inflate", R"(echo '{"program": "menger-inflate", "parameters": {"p": 1}, "seconds": 2, )"
                           R"("inputs_sha256": {"studies/inflate.toml": "12"}}' > $out/manifest.json)");
  ASSERT_EQ(run(), io::exit_code::done);
  const fs::path manifest = folder_ / "results/inflate/manifest.json";
  io::write_whole(manifest, R"({"program": "menger-inflate", "parameters": {"p": 1}, "seconds": 3,
                                "inputs_sha256": {"bar/results/studies/inflate.toml": "12"}})");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), Names{});
  io::write_whole(manifest, R"({"program": "menger-inflate", "parameters": {"p": 2}, "seconds": 2,
                                "inputs_sha256": {"studies/inflate.toml": "12"}})");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"inflate"}));
}

TEST_F(LoopRunTest, FitsWhereMengerHasNoParametersAndFollowsTheFit) {
  change("cell_edge_m = 0.01", "cell_edge_m = 0.011");
  write_program("calibrate", "echo fitted > calibrate/parameters.toml");
  ASSERT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(),
            (Names{"mesh", "inflate", "inflate", "load-cases", "calibrate", "validate", "simulate", "locomote", "locomote"}));
  EXPECT_NE(out_.str().find("menger comes with no parameters for cells of 11 mm"), std::string::npos) << out_.str();
  // A fit that gives other parameters makes all follow that read them, and nothing else.
  write_program("calibrate", "echo fitted otherwise > calibrate/parameters.toml");
  ASSERT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"calibrate", "validate", "simulate"}));
}

TEST_F(LoopRunTest, NumericalOutcomeLeavesOutOnlyWhatNeedsIt) {
  change("cell_edge_m = 0.01", "cell_edge_m = 0.011");
  end_with("inflate", io::exit_code::numerical);
  end_with("load-cases", io::exit_code::numerical);  // curves count as far as they go
  end_with("calibrate", io::exit_code::numerical);
  EXPECT_EQ(run(), io::exit_code::numerical);
  EXPECT_EQ(called(), (Names{"mesh", "inflate", "inflate", "load-cases", "calibrate", "locomote", "locomote"}));
  EXPECT_NE(out_.str().find("left out: needs a result of calibrate"), std::string::npos) << out_.str();
  EXPECT_EQ(run(), io::exit_code::numerical);  // an outcome is an outcome: nothing is repeated
  EXPECT_EQ(called(), Names{});
}

TEST_F(LoopRunTest, RefusedInputAndFailuresAreToldWithTheEndOfTheirLog) {
  write_program("locomote", "echo 'menger-locomote: error: a wrong key' >&2");
  end_with("locomote", io::exit_code::bad_input);
  EXPECT_EQ(run(), io::exit_code::bad_input);
  EXPECT_NE(out_.str().find("refused its input; the end of "), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("  menger-locomote: error: a wrong key\n"), std::string::npos) << out_.str();
  end_with("locomote", 0);
  write_program("simulate", "kill -SEGV $$");
  EXPECT_EQ(run(), 1);
  EXPECT_NE(out_.str().find("failed by signal 11"), std::string::npos) << out_.str();
  EXPECT_EQ(called(), (Names{"simulate", "locomote", "locomote"}));  // what failed is tried again
}

TEST_F(LoopRunTest, GoesOnAfterItWasStopped) {
  write_program("validate", "echo begun > validate/begun; trap 'exit 130' INT; for ((n = 0; n < 600; n++)); do sleep 0.1; done");
  std::thread user([&] {
    while (!fs::exists(folder_ / "results/validate/begun")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stop_ = true;
  });
  EXPECT_EQ(run(), io::exit_code::interrupted);
  user.join();
  stop_ = false;
  EXPECT_NE(out_.str().find("Stopped. Finished stages are kept."), std::string::npos) << out_.str();
  ASSERT_NE(LoopState(folder_ / "results/loop.json").find("validate"), nullptr);
  EXPECT_EQ(LoopState(folder_ / "results/loop.json").find("validate")->status, StageStatus::interrupted);
  write_program("validate", "");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"validate", "simulate", "locomote", "locomote"}));
}

TEST_F(LoopRunTest, StoppedStageGoesOnAndAChangedOneBeginsAnew) {
  end_with("locomote", io::exit_code::interrupted);
  EXPECT_EQ(run("locomote"), io::exit_code::interrupted);
  EXPECT_NE(calls().back().find("--restart"), std::string::npos) << calls().back();
  EXPECT_EQ(run("locomote"), io::exit_code::interrupted);
  EXPECT_EQ(calls().back().find("--restart"), std::string::npos) << calls().back();
  add("[ground]\nkinetic_friction = 0.4\n");
  EXPECT_EQ(run("locomote"), io::exit_code::interrupted);
  EXPECT_NE(calls().back().find("--restart"), std::string::npos) << calls().back();
}

/// What menger inflate does with a checkpoint of another study.
constexpr const char* checks_checkpoint =
    "f=$out/path.checkpoint; [[ \"$*\" = *--restart* ]] && rm -f $f\n"
    "[ ! -e $f ] || cmp -s \"$1\" $f || exit 2\ncp \"$1\" $f";

TEST_F(LoopRunTest, StageThatWasStoppedBeforeItReadItsStudyGoesOnWithoutTheOldCheckpoint) {
  add("[ground]\nkinetic_friction = 0.4\n");
  write_program("locomote", std::string("[ -e '") + (folder_ / "early").string() + "' ] && exit 130\n" + checks_checkpoint);
  ASSERT_EQ(run("locomote"), io::exit_code::done);
  change("kinetic_friction = 0.4", "kinetic_friction = 0.3");
  io::write_whole(folder_ / "early", "");
  ASSERT_EQ(run("locomote"), io::exit_code::interrupted);
  fs::remove(folder_ / "early");
  EXPECT_EQ(run("locomote"), io::exit_code::done) << out_.str();
}

/// A text that tells a waiting program in a file that it has a part.
class WatchedText : public std::stringbuf {
 public:
  WatchedText(std::string part, fs::path seen) : part_(std::move(part)), seen_(std::move(seen)) {}

 private:
  int sync() override {
    if (str().find(part_) != std::string::npos) io::write_whole(seen_, "");
    return 0;
  }

  std::string part_;
  fs::path seen_;
};

TEST_F(LoopRunTest, WithoutATerminalLinesTellHowFarAStageIsAndItsLog) {
  const fs::path seen = folder_ / "seen";
  write_program("validate", "printf '0.5 24 of 48 cases\\n' > $MENGER_PROGRESS_FILE; for ((n = 0; n < 600; n++)); do [ -e '" +
                                seen.string() + "' ] && break; sleep 0.1; done");
  WatchedText text("(24 of 48 cases)", seen);
  std::ostream out(&text);
  const LoopRequest request{
      .robot = folder_ / "robot.toml", .only = "validate", .programs = folder_ / "bin", .stop = &stop_, .tell_every_s = 0.0};
  EXPECT_EQ(run_loop(request, out), io::exit_code::done);
  EXPECT_TRUE(fs::exists(seen)) << text.str();
  EXPECT_NE(text.str().find(", 50 % of its present job are done (24 of 48 cases); see "), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("logs/validate.txt\n"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("\n4 of 7  validate        "), std::string::npos) << text.str();
}

TEST_F(LoopRunTest, WrittenStudiesAreListedWithTheCommandsThatReadThem) {
  write_program("report", "");
  const LoopRequest request{.robot = folder_ / "robot.toml", .only_studies = true, .programs = folder_ / "bin"};
  EXPECT_EQ(run_loop(request, out_), io::exit_code::done);
  EXPECT_EQ(called(), Names{});
  for (const char* part :
       {"studies/inflate.toml\n", "studies/calibrate.toml  (menger comes with these parameters; fitted with --fit)\n",
        "studies/validate_load_cases.toml\n", "  menger inflate studies/limit.toml -o limit\n", "  menger report .\n"})
    EXPECT_NE(out_.str().find(part), std::string::npos) << part << " in " << out_.str();
}

TEST_F(LoopRunTest, VerdictLeavesOutResultsOfAnEarlierRobot) {
  const std::string walk =
      R"(printf 'status = "completed"\ntime_s = 5.0\ndisplacement_m = [0.04, 0, 0]\nhorizontal_displacement_body_lengths = 1.0\n' > )";
  write_program("simulate", walk + "$out/result.toml");
  write_program("locomote", walk + "$out/locomotion.toml");
  ASSERT_EQ(run(), io::exit_code::done);
  EXPECT_NE(out_.str().find("Finite elements of two meshes agree"), std::string::npos) << out_.str();
  add("[walk]\nfidelity = \"fine\"\n");
  ASSERT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(out_.str().find("a finer mesh"), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("The surrogate walks as finite elements do"), std::string::npos) << out_.str();
  change("cell_edge_m = 0.01", "cell_edge_m = 0.011");
  end_with("calibrate", io::exit_code::numerical);  // so nothing is simulated
  EXPECT_EQ(run(), io::exit_code::numerical);
  EXPECT_EQ(out_.str().find("The surrogate "), std::string::npos) << out_.str();
  change("fidelity = \"fine\"", "present = false");
  EXPECT_EQ(run(), io::exit_code::numerical);
  EXPECT_EQ(out_.str().find("What came out"), std::string::npos) << out_.str();
}

TEST_F(LoopRunTest, StageThatWasKilledRunsAgain) {
  ASSERT_EQ(run(), io::exit_code::done);
  LoopState state(folder_ / "results/loop.json");
  StageRecord record = *state.find("inflate");
  record.status = StageStatus::begun;
  state.set("inflate", record);
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"inflate"}));
}

TEST_F(LoopRunTest, UntilEndsThereAndOnlyRunsOneStage) {
  EXPECT_EQ(run("inflate"), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"mesh", "inflate"}));
  EXPECT_EQ(run("", "locomote"), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"locomote"}));
  EXPECT_NE(tests::message_of([&] { run("inflat"); }).find("did you mean inflate?"), std::string::npos);
  EXPECT_NE(tests::message_of([&] { run("calibrate"); }).find("this robot has no such stage. Its stages: mesh, "),
            std::string::npos);
  change("cell_edge_m = 0.01", "cell_edge_m = 0.011");
  EXPECT_NE(tests::message_of([&] { run("", "simulate"); }).find("needs a result of calibrate"), std::string::npos);
}

TEST_F(LoopRunTest, ResultsOfStagesThatARobotNoLongerHasAreLeftBehind) {
  ASSERT_EQ(run(), io::exit_code::done);
  add("[walk]\npresent = false\n");
  ASSERT_EQ(run("limit"), io::exit_code::done);
  EXPECT_EQ(left_behind(), (Names{"locomote/manifest.json", "locomote_finer/manifest.json", "simulate/manifest.json"}));
}

TEST_F(LoopRunTest, OnlyTakesNoResultsThatAChangeMadeOld) {
  change("cell_edge_m = 0.01", "cell_edge_m = 0.011");
  write_program("calibrate", "echo fitted > calibrate/parameters.toml");
  ASSERT_EQ(run(), io::exit_code::done);
  add("[ground]\nkinetic_friction = 0.4\n");
  EXPECT_EQ(run("", "simulate"), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"simulate"}));
  change("dragon_skin_10", "dragon_skin_20");
  EXPECT_NE(tests::message_of([&] { run("", "simulate"); }).find("needs a result of calibrate"), std::string::npos);
  ASSERT_EQ(run("calibrate"), io::exit_code::done);
  EXPECT_EQ(run("", "simulate"), io::exit_code::done);
  write_program("load-cases", "# another version");  // calibrate follows it
  EXPECT_NE(tests::message_of([&] { run("", "simulate"); }).find("needs a result of calibrate"), std::string::npos);
}

TEST_F(LoopRunTest, SearchThatFindsTheBodyComesFirst) {
  change("layers = [[\"1111\"]]", "design = \"evolve\"");
  const std::string design = "name = \\\"c\\\"\\ncell_edge_m = 0.01\\nlayers = [[\\\"1001\\\"], [\\\"1111\\\"]]\\n";
  write_program("export", "printf \"" + design + "\" > export/champion.toml");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"evolve", "export", "mesh", "inflate", "inflate", "validate", "simulate", "locomote", "locomote",
                             "reevaluate"}));
  EXPECT_NE(io::read_whole(folder_ / "results/studies/inflate.toml").find("digits = \"10011111\""), std::string::npos);
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), Names{});
}

TEST_F(LoopRunTest, ArchiveOfAnotherSearchIsKeptAside) {
  add("[search]\ngenerations = 1\n");
  // As menger evolve does: an archive of another study is refused.
  write_program("evolve", "cmp -s \"$1\" evolve/study || [ ! -e evolve/study ] || exit 2; cp \"$1\" evolve/study");
  ASSERT_EQ(run(), io::exit_code::done);
  change("generations = 1", "generations = 2");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"evolve", "evolve", "export", "reevaluate"}));
  EXPECT_NE(io::read_whole(folder_ / "results/earlier/evolve_1/study").find("generations = 1"), std::string::npos);
  EXPECT_NE(io::read_whole(folder_ / "results/evolve/study").find("generations = 2"), std::string::npos);
}

TEST_F(LoopRunTest, ArchiveStaysWhereItIsWhenASearchIsRefusedForAnotherReason) {
  add("[search]\ngenerations = 1\n");
  const std::string archives = "cmp -s \"$1\" evolve/study || [ ! -e evolve/study ] || exit 2; cp \"$1\" evolve/study";
  const std::string disk = (folder_ / "full").string();
  write_program("evolve", "[ -e '" + disk + "' ] && exit 2\n[ -e '" + disk + ".early' ] && exit 130\n" + archives);
  ASSERT_EQ(run("evolve"), io::exit_code::done);
  LoopState state(folder_ / "results/loop.json");
  StageRecord record = *state.find("evolve");
  record.status = StageStatus::interrupted;
  state.set("evolve", record);
  io::write_whole(disk, "");
  EXPECT_EQ(run("evolve"), io::exit_code::bad_input);
  EXPECT_TRUE(fs::exists(folder_ / "results/evolve/study"));
  EXPECT_FALSE(fs::exists(folder_ / "results/earlier"));
  // With another study it makes way, but not where that is refused, too.
  change("generations = 1", "generations = 2");
  EXPECT_EQ(run("evolve"), io::exit_code::bad_input);
  EXPECT_TRUE(fs::exists(folder_ / "results/evolve/study"));
  EXPECT_FALSE(fs::exists(folder_ / "results/earlier"));
  // It also makes way if the first run for the other study was stopped at once.
  fs::remove(disk);
  io::write_whole(disk + ".early", "");
  EXPECT_EQ(run("evolve"), io::exit_code::interrupted);
  fs::remove(disk + ".early");
  EXPECT_EQ(run("evolve"), io::exit_code::done) << out_.str();
  EXPECT_TRUE(fs::exists(folder_ / "results/earlier/evolve_1/study"));
}

TEST_F(LoopRunTest, ArchiveThatIsInUseStaysWhereItIs) {
  add("[search]\ngenerations = 1\n");
  // As menger evolve does: an archive in use is refused as one of another study is.
  write_program("evolve",
                "[ -e evolve/run.sqlite.lock ] && exit 2\ncmp -s \"$1\" evolve/study || [ ! -e evolve/study ] || exit 2; cp "
                "\"$1\" evolve/study");
  ASSERT_EQ(run("evolve"), io::exit_code::done);
  change("generations = 1", "generations = 2");
  {
    const io::FileLock of_a_search_by_hand(folder_ / "results/evolve/run.sqlite");
    EXPECT_EQ(run("evolve"), io::exit_code::bad_input);
    EXPECT_EQ(called(), Names{"evolve"}) << "it is not started again";
    EXPECT_NE(out_.str().find("evolve/run.sqlite is in use by another process: its folder stays where it is"), std::string::npos)
        << out_.str();
    EXPECT_NE(io::read_whole(folder_ / "results/evolve/study").find("generations = 1"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder_ / "results/earlier"));
  }
  EXPECT_EQ(run("evolve"), io::exit_code::done) << out_.str();
  EXPECT_NE(io::read_whole(folder_ / "results/earlier/evolve_1/study").find("generations = 1"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "results/earlier/evolve_1/run.sqlite.lock"));
}

TEST_F(LoopRunTest, ReportIsTheLastStageIfItsProgramIsThere) {
  write_program("report", "echo page > report.html");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(calls().back(), "report " + (folder_ / "results").string());
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), Names{});
  add("[ground]\nkinetic_friction = 0.4\n");
  EXPECT_EQ(run(), io::exit_code::done);
  EXPECT_EQ(called(), (Names{"simulate", "locomote", "locomote", "report"}));
}

TEST_F(LoopRunTest, LeavesWhatCameOutForTheReport) {
  const std::string walk =
      R"(printf 'status = "completed"\ntime_s = 5.0\ndisplacement_m = [0.04, 0, 0]\nhorizontal_displacement_body_lengths = 1.0\n' > )";
  write_program("simulate", walk + "$out/result.toml");
  write_program("locomote", walk + "$out/locomotion.toml");
  write_program("report", "cp loop_verdict.json report.html");
  ASSERT_EQ(run(), io::exit_code::done);
  const std::optional<LoopVerdict> verdict = read_loop_verdict(folder_ / "results");
  ASSERT_TRUE(verdict);
  ASSERT_FALSE(verdict->lines.empty());
  ASSERT_FALSE(verdict->forecast.empty());
  for (const std::string& line : verdict->forecast) EXPECT_NE(out_.str().find(line + "\n"), std::string::npos) << line;
  for (const std::string& line : verdict->lines) EXPECT_NE(out_.str().find("- " + line + "\n"), std::string::npos) << line;
  EXPECT_EQ(io::read_whole(folder_ / "results/report.html"), io::read_whole(folder_ / "results/loop_verdict.json"))
      << "the report is made when the verdict is there";
  EXPECT_TRUE(verdict->changed(folder_ / "results").empty());
  EXPECT_TRUE(verdict->results.contains("mesh/mesh_manifest.json"));
  io::write_whole(folder_ / "results/locomote/manifest.json", "{\"another\": 1}");
  EXPECT_FALSE(verdict->changed(folder_ / "results").empty());
}

TEST_F(LoopRunTest, FirstLinesRepeatTheExpectedErrorOfSimulate) {
  change("layers = [[\"1111\"]]", "layers = [[\"000\", \"101\", \"000\"], [\"111\", \"111\", \"111\"]]");
  ASSERT_EQ(run("mesh"), io::exit_code::done);
  EXPECT_NE(out_.str().find("bar: 11 cells of 10 mm with walls of 2 mm, Dragon Skin 10, one chamber, 0 to 6 kPa at 3 Hz"),
            std::string::npos)
      << out_.str();
  EXPECT_NE(out_.str().find("\nlaw: initial shear modulus "), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("(dragon_skin_10_1cm.toml)"), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("expected error for a plate on legs: "), std::string::npos) << out_.str();
}

TEST_F(LoopRunTest, SaysWhatToExpectOfTheBodyThatASearchFound) {
  change("layers = [[\"1111\"]]", "design = \"evolve\"");
  const std::string table = "layers = [[\\\"000\\\", \\\"101\\\", \\\"000\\\"], [\\\"111\\\", \\\"111\\\", \\\"111\\\"]]\\n";
  write_program("export", "printf \"name = \\\"c\\\"\\ncell_edge_m = 0.01\\n" + table + "\" > export/champion.toml");
  write_program("report", "echo page > report.html");
  ASSERT_EQ(run(), io::exit_code::done) << out_.str();
  const std::optional<LoopVerdict> verdict = read_loop_verdict(folder_ / "results");
  ASSERT_TRUE(verdict);
  const std::string of_found = io::joined(verdict->forecast, "\n");
  EXPECT_NE(of_found.find("\nexpected error for a plate on legs: "), std::string::npos) << of_found;
  EXPECT_EQ(out_.str().find("expected error for a plate on legs: "), std::string::npos) << "the search may find any body";
}

TEST_F(LoopRunTest, FirstLinesWarnOfParametersForOtherCells) {
  fs::copy_file(io::data_folder(io::parameter_data) / "ecoflex_00_30_12mm.toml", folder_ / "mine.toml");
  add("[surrogate]\nparameters = \"mine.toml\"\n");
  ASSERT_EQ(run("mesh"), io::exit_code::done);
  EXPECT_NE(out_.str().find("\nwarning: mine.toml was fitted for something else (holds_for): silicone Ecoflex 00-30 in place of "
                            "Dragon Skin 10, law "),
            std::string::npos)
      << out_.str();
  EXPECT_NE(out_.str().find("\nexpected error: not known for this silicone and these cells; the stage validate measures it"),
            std::string::npos)
      << out_.str();
}

TEST_F(LoopRunTest, RefusesParametersThatAreNotThere) {
  add("[surrogate]\nparameters = \"lost.toml\"\n");
  const std::string message = tests::message_of([&] { run("mesh"); });
  EXPECT_NE(message.find("robot.toml: surrogate.parameters = "), std::string::npos) << message;
  EXPECT_NE(message.find("lost.toml\": there is no such file; dragon_skin_10_0.667cm, "), std::string::npos) << message;
}

TEST_F(LoopRunTest, TellsWhatChangedSinceTheLastRun) {
  ASSERT_EQ(run("mesh"), io::exit_code::done);
  EXPECT_EQ(out_.str().find("changed since"), std::string::npos) << out_.str();
  change("cell_edge_m = 0.01", "cell_edge_m = 0.011");
  add("[walk]\nduration_s = 2\n");
  ASSERT_EQ(run("mesh"), io::exit_code::done);
  EXPECT_NE(out_.str().find("\nchanged since the last finished run: robot.cell_edge_m 0.01 -> 0.011\n"), std::string::npos)
      << out_.str();
  EXPECT_NE(out_.str().find("\nchanged since the last finished run: walk.duration_s 5 -> 2\n"), std::string::npos) << out_.str();
}

TEST_F(LoopRunTest, ReplacesNothingThatNoLoopHasMade) {
  io::write_whole(folder_ / "mine/report.html", "my report");
  io::write_whole(folder_ / "mine/mesh/mesh.vtu", "my mesh");
  const LoopRequest request{
      .robot = folder_ / "robot.toml", .results = folder_ / "mine", .until = "mesh", .programs = folder_ / "bin", .stop = &stop_};
  const std::string message = tests::message_of([&] { run_loop(request, out_); });
  EXPECT_NE(message.find("mine: holds report.html, mesh, which no loop has made"), std::string::npos) << message;
  EXPECT_EQ(io::read_whole(folder_ / "mine/report.html"), "my report");
  EXPECT_FALSE(fs::exists(folder_ / "mine/logs"));
}

TEST_F(LoopRunTest, ReplacesNoResultsOfAnotherCommand) {
  const std::string manifest = "{\"program\": \"menger-simulate\"}";
  io::write_whole(folder_ / "results/manifest.json", manifest);
  const std::string message = tests::message_of([&] { run("mesh"); });
  EXPECT_NE(message.find("results: holds results of menger simulate: choose another folder with -o"), std::string::npos)
      << message;
  EXPECT_EQ(io::read_whole(folder_ / "results/manifest.json"), manifest);
  EXPECT_FALSE(fs::exists(folder_ / "results/logs"));
}

TEST_F(LoopRunTest, ReplacesNoResultsOfAnotherRobot) {
  ASSERT_EQ(run("mesh"), io::exit_code::done);
  io::write_whole(folder_ / "other.toml", robot_text);
  const LoopRequest other{.robot = folder_ / "other.toml", .until = "mesh", .programs = folder_ / "bin", .stop = &stop_};
  const std::string message = tests::message_of([&] { run_loop(other, out_); });
  EXPECT_NE(message.find("robot.toml, which this loop would replace: name another folder with -o"), std::string::npos) << message;
  EXPECT_NE(message.find("other_results"), std::string::npos) << message;
  fs::remove(folder_ / "robot.toml");
  EXPECT_EQ(run_loop(other, out_), io::exit_code::done) << "a robot that was given another name keeps its results";
}

TEST_F(LoopRunTest, KnowsAnotherRobotWhoseResultsAreNamedFromElsewhere) {
  fs::create_directories(folder_ / "one");
  fs::create_directories(folder_ / "two");
  const auto loop = [&](const char* name) {
    io::write_whole(folder_ / name / "robot.toml", robot_text);
    return LoopRequest{.robot = folder_ / name / "robot.toml",
                       .results = folder_ / name / "../shared",
                       .until = "mesh",
                       .programs = folder_ / "bin",
                       .stop = &stop_};
  };
  ASSERT_EQ(run_loop(loop("one"), out_), io::exit_code::done);
  const std::string message = tests::message_of([&] { run_loop(loop("two"), out_); });
  EXPECT_NE(message.find("one/robot.toml, which this loop would replace"), std::string::npos) << message;
  LoopRequest studies = loop("two");
  studies.only_studies = true;
  EXPECT_NE(tests::message_of([&] { run_loop(studies, out_); }).find("would replace"), std::string::npos);
  ASSERT_EQ(run_loop(loop("one"), out_), io::exit_code::done);
}

TEST_F(LoopRunTest, RobotWithAnotherNameIsNotedAlthoughNothingIsComputed) {
  ASSERT_EQ(run("mesh"), io::exit_code::done);
  fs::rename(folder_ / "robot.toml", folder_ / "renamed.toml");
  const LoopRequest renamed{.robot = folder_ / "renamed.toml", .until = "mesh", .programs = folder_ / "bin", .stop = &stop_};
  ASSERT_EQ(run_loop(renamed, out_), io::exit_code::done);
  io::write_whole(folder_ / "robot.toml", robot_text);
  EXPECT_EQ(run_loop(renamed, out_), io::exit_code::done) << "the results are those of renamed.toml";
}

TEST_F(LoopRunTest, CopyOfARobotAndItsResultsGoesOn) {
  ASSERT_EQ(run("mesh"), io::exit_code::done);
  fs::create_directories(folder_ / "copy");
  fs::copy(folder_ / "results", folder_ / "copy/results", fs::copy_options::recursive);
  fs::copy_file(folder_ / "robot.toml", folder_ / "copy/robot.toml");
  const LoopRequest copy{.robot = folder_ / "copy/robot.toml", .until = "mesh", .programs = folder_ / "bin", .stop = &stop_};
  EXPECT_EQ(run_loop(copy, out_), io::exit_code::done);
}

TEST_F(LoopRunTest, FirstLinesWarnOfWallsThatLeaveHardlyAChamber) {
  ASSERT_EQ(run("mesh"), io::exit_code::done);
  EXPECT_EQ(out_.str().find("hardly a chamber"), std::string::npos) << out_.str();
  change("cell_edge_m = 0.01", "cell_edge_m = 0.01\nwall_thickness_m = 0.0049");
  ASSERT_EQ(run("mesh"), io::exit_code::done);
  EXPECT_NE(
      out_.str().find("note: walls of 4.9 mm leave 0.2 mm of air between them, which is hardly a chamber; the default pressure"),
      std::string::npos)
      << out_.str();
}

TEST_F(LoopRunTest, WrongInputWritesNothing) {
  add("colour = 3\n");
  EXPECT_NE(tests::message_of([&] { run(); }).find("colour"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "results"));
  fs::remove(folder_ / "bin/menger-validate");
  change("colour = 3\n", "");
  EXPECT_NE(tests::message_of([&] { run(); }).find("menger-validate: there is no such program"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "results"));
}

TEST_F(LoopRunTest, TakesTheFolderOfARobotForTheRobot) {
  const LoopRequest request{.robot = fs::path(folder_), .until = "mesh", .programs = folder_ / "bin", .stop = &stop_};
  EXPECT_EQ(run_loop(request, out_), io::exit_code::done);
  EXPECT_TRUE(fs::exists(folder_ / "results/mesh"));
}

TEST_F(LoopRunTest, RefusesAStateThatItCannotRead) {
  io::write_whole(folder_ / "results/loop.json", "{\"stages\": {\"mesh\": 3}}");
  EXPECT_NE(tests::message_of([&] { run(); }).find("loop.json: is no state of a loop"), std::string::npos);
}

}  // namespace
}  // namespace menger::evolution
