#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "tests/support/paraview_files.h"
#include "tests/support/surrogate_example.h"
#include "tests/support/test_folder.h"
#include "voxel/model/expected_errors.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/picture/vtk_output.h"

namespace menger {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

/// A scene of two cells of opposite phase on the ground, for three records.
constexpr const char* small_scene = R"(
[time]
duration_s = 0.03
record_interval_s = 0.01
[design]
name = "pair"
cell_edge_m = 0.01
cells = [2, 1, 1]
digits = "12"
)";

/// The program in a folder of its own.
class Simulate : public testing::Test {
 protected:
  void write_scene(const std::string& text) const { io::write_whole(folder_ / "scene.toml", text); }

  /// Starts the program in the folder. Its output goes to the files out and err there.
  [[nodiscard]] pid_t start(std::vector<std::string> arguments,
                            const std::vector<std::pair<std::string, std::string>>& environment = {}) const {
    arguments.insert(arguments.begin(), std::string(MENGER_PROGRAM_DIR).append("/menger-simulate"));
    std::vector<char*> words;
    words.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder_.path().c_str()) != 0) _exit(126);
      for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
      dup2(open("out", O_CREAT | O_TRUNC | O_WRONLY, 0644), STDOUT_FILENO);
      dup2(open("err", O_CREAT | O_TRUNC | O_WRONLY, 0644), STDERR_FILENO);
      execv(words[0], words.data());
      _exit(126);
    }
    return child;
  }

  [[nodiscard]] Outcome end_of(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
            .out = io::read_whole(folder_ / "out"),
            .err = io::read_whole(folder_ / "err")};
  }

  [[nodiscard]] Outcome run(const std::vector<std::string>& arguments,
                            const std::vector<std::pair<std::string, std::string>>& environment = {}) const {
    return end_of(start(arguments, environment));
  }

  [[nodiscard]] vtkIdType voxels_in(const fs::path& file) const {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput()->GetNumberOfCells();
  }

  const tests::TestFolder folder_;
};

TEST_F(Simulate, FilesAgreeWithOneAnother) {
  write_scene(std::string(small_scene) + "level = 2\n");
  const Outcome outcome = run({"scene.toml", "-o", "result", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("completed"), std::string::npos) << outcome.out;

  const io::CsvContents trajectory = io::read_csv(folder_ / "result/trajectory.csv");
  ASSERT_EQ(trajectory.row_count(), 4U);
  const auto frames = voxel::read_collection(folder_ / "result/frames.pvd");
  ASSERT_EQ(frames.size(), 4U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].time_s, trajectory.number(i, "time_s"));
    EXPECT_NEAR(frames[i].time_s, 0.01 * static_cast<double>(i), 1e-4);
    EXPECT_EQ(voxels_in(folder_ / "result" / frames[i].file), 4);
  }
  test_support::expect_opens_in_paraview(folder_ / "result");

  const io::TomlTable result = io::read_toml(folder_ / "result/result.toml");
  EXPECT_EQ(result.text("status"), "completed");
  EXPECT_EQ(result.integer("voxels"), 4);
  EXPECT_EQ(result.integer("records"), 4);
  EXPECT_DOUBLE_EQ(result.number("body_length_m"), 0.04);
  EXPECT_EQ(result.number("time_s"), trajectory.number(3, "time_s"));
  EXPECT_EQ(result.number("horizontal_displacement_m"), trajectory.number(3, "horizontal_displacement_m"));
  EXPECT_DOUBLE_EQ(trajectory.number(3, "horizontal_displacement_body_lengths"),
                   trajectory.number(3, "horizontal_displacement_m") / 0.04);
  EXPECT_TRUE(fs::exists(folder_ / "result/manifest.json"));
}

TEST_F(Simulate, ReplacesNoResultsOfAnotherCommand) {
  write_scene(std::string(small_scene));
  io::write_whole(folder_ / "result/manifest.json", "{\"program\": \"menger-inflate\"}");
  io::write_whole(folder_ / "result/result.toml", "of the inflation");
  const Outcome outcome = run({"scene.toml", "-o", "result", "--no-pictures"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "menger-simulate: error: result: holds results of menger inflate: choose another folder with -o\n");
  EXPECT_EQ(io::read_whole(folder_ / "result/result.toml"), "of the inflation");
  EXPECT_FALSE(fs::exists(folder_ / "result/trajectory.csv"));
}

TEST_F(Simulate, SaysWhichErrorToExpectOfACalibratedBody) {
  const voxel::SurrogateParameters parameters = tests::surrogate_example();
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(parameters));
  write_scene(std::string(small_scene) +
              "[surrogate]\nparameters = \"soft.toml\"\n[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 1500]\n");
  const std::string unknown = "warning: the error of these parameters is unknown: no table of errors lies beside soft.toml";
  EXPECT_NE(run({"scene.toml", "-o", "result", "--no-pictures"}).out.find(unknown), std::string::npos);
  EXPECT_NE(io::read_whole(folder_ / "result/result.toml").find(unknown), std::string::npos);
  voxel::ExpectedErrors errors{.parameters_hash = voxel::hash_of(parameters)};
  errors.kinds[static_cast<std::size_t>(voxel::BodyKind::limbs)] = {
      .bodies = {"l"}, .displacements = 5, .displacement_median = 0.07, .displacement_ninth_decile = 0.2};
  voxel::expected_errors_table(errors).write(folder_ / "soft.errors.csv");
  const std::string known = "expected error for a body of limbs: 7 % in displacement";
  EXPECT_EQ(run({"scene.toml", "-o", "result", "--no-pictures"}).out.rfind(known, 0), 0U) << "before it starts";
  EXPECT_NE(io::read_whole(folder_ / "result/result.toml").find(known), std::string::npos);
  EXPECT_NE(io::read_whole(folder_ / "result/manifest.json").find("soft.errors.csv"), std::string::npos);
  io::write_whole(folder_ / "soft.errors.csv", "kind\nlimbs\n");
  const Outcome refused = run({"scene.toml", "-o", "other", "--no-pictures"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("soft.errors.csv"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(folder_ / "other"));
}

TEST_F(Simulate, EveryTermAndEveryInstructionSetGiveTheSameBytes) {
  write_scene(std::string(small_scene) + "level = 2\n");
  ASSERT_EQ(run({"scene.toml", "-o", "best", "--no-pictures"}).code, 0);
  ASSERT_EQ(run({"scene.toml", "-o", "scalar", "--no-pictures", "--instruction-set", "scalar"}).code, 0);
  ASSERT_EQ(run({"scene.toml", "-o", "every", "--no-pictures", "--every-term"}).code, 0);
  for (const char* file : {"trajectory.csv", "frames/frame_0003.vtu"}) {
    EXPECT_EQ(io::read_whole(folder_ / "best" / file), io::read_whole(folder_ / "scalar" / file)) << file;
    EXPECT_EQ(io::read_whole(folder_ / "best" / file), io::read_whole(folder_ / "every" / file)) << file;
  }
}

TEST_F(Simulate, LevelAndEnergyComeFromTheCommandLine) {
  write_scene(small_scene);
  ASSERT_EQ(run({"scene.toml", "-o", "result", "--no-pictures", "--level", "2", "--energy"}).code, 0);
  EXPECT_EQ(io::read_toml(folder_ / "result/result.toml").integer("voxels"), 4);
  EXPECT_TRUE(io::read_csv(folder_ / "result/trajectory.csv").has("energy_residual_J"));
}

TEST_F(Simulate, ChecksItsStepOnRequest) {
  write_scene(small_scene);
  const Outcome outcome = run({"scene.toml", "-o", "result", "--no-pictures", "--check-dt"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("half the step"), std::string::npos) << outcome.out;
  const io::TomlTable check = io::read_toml(folder_ / "result/result.toml").table("check_dt");
  EXPECT_EQ(check.text("status"), "completed");
  EXPECT_EQ(io::read_csv(folder_ / "result/check_dt.csv").row_count(), 4U);
  ASSERT_EQ(run({"scene.toml", "-o", "result", "--no-pictures"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "result/check_dt.csv"));
  EXPECT_FALSE(io::read_toml(folder_ / "result/result.toml").has("check_dt"));
}

TEST_F(Simulate, DrawsPicturesOrSaysWhatIsMissing) {
  write_scene(small_scene);
  const Outcome outcome = run({"scene.toml", "-o", "result"}, {{"DISPLAY", ":987"}});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const bool drawn = fs::exists(folder_ / "result/robot.png");
  EXPECT_EQ(drawn, fs::exists(folder_ / "result/trajectory.png"));
  EXPECT_EQ(drawn, outcome.out.find("no pictures") == std::string::npos) << outcome.out;
}

TEST_F(Simulate, GoesOnWithoutDisplayAndXvfb) {
  write_scene(small_scene);
  const Outcome outcome = run({"scene.toml", "-o", "result"}, {{"DISPLAY", ""}, {"PATH", "/nowhere"}});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("no pictures"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("xvfb"), std::string::npos) << outcome.out;
  EXPECT_FALSE(fs::exists(folder_ / "result/robot.png"));
  EXPECT_EQ(io::read_toml(folder_ / "result/result.toml").text("status"), "completed");
}

TEST_F(Simulate, HelpShowsAnExample) {
  const Outcome outcome = run({"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("menger simulate voxel/scenes/"), std::string::npos) << outcome.out;
}

TEST_F(Simulate, RunsItsTemplate) {
  const Outcome outcome = run({"--template"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  write_scene(outcome.out);
  const Outcome walk = run({"scene.toml", "-o", "result", "--no-pictures"});
  EXPECT_EQ(walk.code, 0) << walk.err;
  EXPECT_NE(run({"--keys"}).out.find("drive.frequency_Hz"), std::string::npos);
  EXPECT_NE(run({"--schema"}).out.find("\"frequency_Hz\""), std::string::npos);
}

struct BadInput {
  std::string scene;
  std::vector<std::string> arguments;
  std::vector<std::string> named;  ///< words that the message must have
};

TEST_F(Simulate, BadInputIsNamedAndOverwritesNothing) {
  const std::string design = "[design]\ncell_edge_m = 0.01\ncells = [1, 1, 1]\ndigits = \"1\"\n";
  const std::string cube = "[design]\ncell_edge_m = 0.01\ncells = [3, 3, 3]\ndigits = \"" + std::string(27, '1') + "\"\n";
  const std::vector<BadInput> cases{
      {"steps = 4\n" + design, {}, {"scene.toml", "steps"}},
      {"[time]\nduration_s = \"long\"\n" + design, {}, {"scene.toml", "duration_s", "long"}},
      {design + "[materials]\nyoungs_modulus_Pa = -1e4\n", {}, {"scene.toml", "materials.youngs_modulus_Pa", "-10000"}},
      {"[design]\ncell_edge_m = 0.01\ncells = [1, 1, 1]\ndigits = \"0\"\n", {}, {"scene.toml", "design.digits", "empty"}},
      {"[design]\nfile = \"nowhere.toml\"\n", {}, {"nowhere.toml"}},
      {"design = 5\n", {}, {"scene.toml", "design = 5", "table"}},
      {design + "level = 2147483647\n", {}, {"scene.toml", "level = 2147483647", "[1, 20]"}},
      {cube + "level = 20\n", {}, {"scene.toml", "level = 20", "GiB"}},
      {cube, {"--level", "20"}, {"scene.toml", "--level 20", "GiB"}},
      {design, {"--level", "0"}, {"--level 0", "[1, 20]"}},
      {design, {"--level", "2147483647"}, {"--level 2147483647", "[1, 20]"}},
      {"materials.youngs_modulus_Pa = 1e200\n" + design, {}, {"scene.toml", "youngs_modulus_Pa = 1e+200"}},
      {"integration.time_step_fraction = 1e-320\n" + design, {}, {"scene.toml", "time_step_fraction = 1e-320"}},
      {"[time]\nduration_s = 1e300\nrecord_interval_s = 1e300\n" + design, {}, {"scene.toml", "duration_s = 1e+300"}},
      {design, {"--instruction-set", "mmx"}, {"instruction-set", "mmx"}},
      {design, {"--no-such-option"}, {"no-such-option"}},
  };
  fs::create_directories(folder_ / "result");
  io::write_whole(folder_ / "result/result.toml", "earlier");
  for (const BadInput& bad : cases) {
    write_scene(bad.scene);
    std::vector<std::string> arguments{"scene.toml", "-o", "result"};
    arguments.insert(arguments.end(), bad.arguments.begin(), bad.arguments.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << bad.scene;
    for (const std::string& part : bad.named)
      EXPECT_NE(outcome.err.find(part), std::string::npos) << "no " << part << " in: " << outcome.err;
    EXPECT_EQ(io::read_whole(folder_ / "result/result.toml"), "earlier");
    EXPECT_FALSE(fs::exists(folder_ / "result/trajectory.csv"));
  }
}

TEST_F(Simulate, AMissingSceneIsNamed) {
  const Outcome outcome = run({"nowhere.toml"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("nowhere.toml"), std::string::npos) << outcome.err;
}

TEST_F(Simulate, AnUnwritableFolderIsNamedBeforeAnythingIsComputed) {
  write_scene(std::string(small_scene) + "level = 2\n");
  io::write_whole(folder_ / "file", "text");
  const Outcome outcome = run({"scene.toml", "-o", "file/result"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("file/result"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(io::read_whole(folder_ / "file"), "text");
}

TEST_F(Simulate, ADivergedRunSaysWhichVoxelAndKeepsItsFrames) {
  // In free fall the pair passes 0.2 m/s, which is this fraction of sqrt(E / rho), after 0.0204 s: between the third and the
  // fourth record.
  const std::string free_fall = "[ground]\npresent = false\n[drive]\nmode = \"none\"\n[damping]\nglobal = 0\n";
  write_scene(small_scene + free_fall + "[limits]\nspeed_fraction = 0.0063245553\n");
  const Outcome outcome = run({"scene.toml", "-o", "result", "--no-pictures"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("diverged"), std::string::npos) << outcome.out;

  const io::TomlTable result = io::read_toml(folder_ / "result/result.toml");
  EXPECT_EQ(result.text("status"), "diverged");
  EXPECT_NE(result.text("reason").find("voxel"), std::string::npos);
  EXPECT_FALSE(result.has("displacement_m"));
  const io::TomlTable divergence = result.table("divergence");
  EXPECT_EQ(divergence.integer("voxel"), 0);
  EXPECT_EQ(divergence.text("quantity"), "speed");
  EXPECT_NEAR(divergence.number("limit"), 0.2, 1e-6);
  EXPECT_NEAR(divergence.number("value"), 0.2, 1e-3);
  EXPECT_NEAR(divergence.number("time_s"), 0.2 / 9.81, 1e-4);

  const auto frames = voxel::read_collection(folder_ / "result/frames.pvd");
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(io::read_csv(folder_ / "result/trajectory.csv").row_count(), frames.size());
  for (const auto& frame : frames) EXPECT_EQ(voxels_in(folder_ / "result" / frame.file), 2);
}

TEST_F(Simulate, ManifestHoldsTheInputsAsTheyWereRead) {
  const std::string scene = "[design]\nfile = \"pair.toml\"\n[time]\nduration_s = 1000.0\nrecord_interval_s = 0.01\n";
  const std::string design = "name = \"pair\"\ncell_edge_m = 0.01\nlayers = [[\"12\"]]\n";
  write_scene(scene);
  io::write_whole(folder_ / "pair.toml", design);
  const pid_t child = start({"scene.toml", "-o", "result", "--no-pictures"});
  for (int i = 0; i < 6000 && !fs::exists(folder_ / "result/frames/frame_0000.vtu"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  write_scene("edited while it runs");
  fs::remove(folder_ / "pair.toml");
  kill(child, SIGINT);
  ASSERT_EQ(end_of(child).code, 130);
  const std::string manifest = io::read_whole(folder_ / "result/manifest.json");
  EXPECT_NE(manifest.find("\"scene.toml\": \"" + io::content_hash(scene) + "\""), std::string::npos) << manifest;
  EXPECT_NE(manifest.find("\"pair.toml\": \"" + io::content_hash(design) + "\""), std::string::npos) << manifest;
}

TEST_F(Simulate, CtrlCKeepsTheFramesDone) {
  write_scene(
      "[time]\nduration_s = 1000.0\nrecord_interval_s = 0.01\n[design]\ncell_edge_m = 0.01\ncells = [2, 1, 1]\ndigits = "
      "\"12\"\n");
  const pid_t child = start({"scene.toml", "-o", "result", "--no-pictures"});
  for (int i = 0; i < 6000 && !fs::exists(folder_ / "result/frames/frame_0002.vtu"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child, SIGINT);
  const Outcome outcome = end_of(child);
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_NE(outcome.out.find("stopped"), std::string::npos) << outcome.out;

  const io::TomlTable result = io::read_toml(folder_ / "result/result.toml");
  EXPECT_EQ(result.text("status"), "stopped");
  EXPECT_FALSE(result.has("displacement_m"));
  const auto frames = voxel::read_collection(folder_ / "result/frames.pvd");
  ASSERT_GE(frames.size(), 3U);
  EXPECT_EQ(voxels_in(folder_ / "result" / frames.back().file), 2);
  EXPECT_TRUE(fs::exists(folder_ / "result/manifest.json"));
}

}  // namespace
}  // namespace menger
