#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/observables.h"
#include "meshes/robot/command_study.h"
#include "voxel/kernels/instruction_sets.h"
#include "voxel/kernels/kernel_choice.h"
#include "voxel/model/expected_errors.h"
#include "voxel/scene/calibrated_body_file.h"
#include "voxel/scene/scene_file.h"
#include "voxel/simulate/simulation_run.h"

namespace {

using namespace menger;

struct Arguments {
  std::filesystem::path scene;
  std::filesystem::path folder;
  std::optional<int> level;
  bool no_pictures = false;
  bool energy = false;
  bool check_dt = false;
  std::string instruction_set = "best";
  voxel::KernelOptions kernel;
};

const std::map<std::string, voxel::InstructionSet>& instruction_sets() {
  using voxel::InstructionSet;
  static const std::map<std::string, InstructionSet> sets{{"best", InstructionSet::best},
                                                          {"scalar", InstructionSet::scalar},
                                                          {"sse2", InstructionSet::sse2},
                                                          {"avx2", InstructionSet::avx2},
                                                          {"avx512", InstructionSet::avx512}};
  return sets;
}

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app("Simulates a voxel robot in a scene and writes its trajectory, its frames for ParaView and pictures.",
               "menger simulate");
  app.footer(
      "Example:\n  menger simulate voxel/scenes/menger.toml -o walk\n"
      "writes walk/result.toml, trajectory.csv, frames.pvd (open it in ParaView), robot.png, trajectory.png and "
      "manifest.json.\n"
      "With --check-dt the scene runs a second time with half the time step; result.toml and check_dt.csv then contain the "
      "differences.\n"
      "Example of a silicone body driven by air, with calibrated parameters: voxel/scenes/silicone.toml.\n"
      "Exit codes: 0 completed, 2 wrong input, 3 diverged, 130 interrupted.");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    voxel::Scene scene;
    describe(visitor, scene);
  });
  app.add_option("scene", arguments.scene, "scene file, or robot.toml of menger init or its folder")->required();
  app.add_option("-o,--output", arguments.folder,
                 "folder of the results (default: the name of the scene file; of a robot, its folder in results)");
  app.add_option("--level", arguments.level, "level of the fractal, instead of the scene's");
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG pictures");
  app.add_flag("--energy", arguments.energy, "compute the energy balance (slow)");
  app.add_flag("--check-dt", arguments.check_dt,
               "run again with half the time step and report the difference (three times the work)");
  app.add_flag("--every-term", arguments.kernel.every_term,
               "compute every term in every step; slower, with the same results byte for byte");
  app.add_option("--threads", arguments.kernel.threads,
                 "threads that share every step of an aggregate, whose copies are computed in SIMD lanes; the results are "
                 "the same byte for byte for any number")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--instruction-set", arguments.instruction_set, "kernels to use; all give the same results byte for byte")
      ->check(CLI::IsMember(instruction_sets()));
  return io::parse_arguments(app, argc, argv);
}

void print_kernel_report(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::cout << "  " << line << '\n';
  std::cout << std::flush;
}

void print_check(const voxel::StepCheck& check, double body_length_m) {
  std::cout << "half the step, " << io::shown(check.time_step_s) << " s: " << io::to_string(check.status);
  if (check.displacement_m) {
    const double distance_m = meshes::horizontal_displacement(*check.displacement_m);
    std::cout << ", " << io::duration_text(check.seconds) << "; moved " << io::shown(1e3 * distance_m)
              << " mm = " << io::shown(distance_m / body_length_m) << " body lengths";
  } else {
    std::cout << ", " << check.reason;
  }
  if (check.horizontal_change_m)
    std::cout << ", difference " << io::formatted("%+.3g", 1e3 * *check.horizontal_change_m) << " mm";
  std::cout << "; largest distance between the centres of mass: " << io::shown(1e3 * check.largest_distance_m, 3) << " mm, at "
            << io::shown(check.largest_distance_time_s) << " s\n";
}

void print_outcome(const voxel::SceneResult& result, const std::filesystem::path& folder) {
  for (const std::string& note : result.notes) std::cout << note << '\n';
  std::cout << io::to_string(result.status) << ": " << io::shown(result.time_s) << " s in " << result.steps << " steps of "
            << io::shown(result.time_step_s) << " s, " << result.voxels << " voxels, " << io::duration_text(result.seconds);
  if (result.displacement_m) {
    const double distance_m = meshes::horizontal_displacement(*result.displacement_m);
    std::cout << "; moved " << io::shown(1e3 * distance_m) << " mm = " << io::shown(distance_m / result.body_length_m)
              << " body lengths";
  } else {
    std::cout << "; " << result.reason;
  }
  std::cout << '\n';
  if (result.step_check) print_check(*result.step_check, result.body_length_m);
  std::cout << "results in " << folder.string() << '\n';
}

/// A run and its check.
int exit_code_of(const voxel::SceneResult& result) {
  std::vector<io::RunStatus> parts{result.status};
  if (result.step_check) parts.push_back(result.step_check->status);
  return io::exit_code_of(parts);
}

void choose_kernels(Arguments& arguments) {
  const voxel::InstructionSet requested = instruction_sets().at(arguments.instruction_set);
  try {
    arguments.kernel.instruction_set = voxel::resolve(requested);
  } catch (const std::invalid_argument& error) {
    throw io::InputError("--instruction-set " + arguments.instruction_set + ": " + error.what());
  }
}

/// Runs the scene again with half the step. The results of the run stay unchanged until the check is done.
void check_step(const voxel::Scene& scene, const std::filesystem::path& folder, voxel::RunOptions options,
                voxel::SceneResult& result) {
  io::Progress progress(scene.design.name + ", half the step", scene.duration_s);
  options.progress = [&](const voxel::RunProgress& now) {
    progress.update(now.time_s, io::shown(now.simulated_s_per_second, 3) + " simulated s/s");
  };
  voxel::add_step_check(scene, folder, options, result);
}

/// Finds what to expect of the body of a scene, and prints it. Solid voxels have no table of errors.
/// @param inputs gets the table, if there is one
std::vector<std::string> print_expected_error(const voxel::Scene& scene, const std::filesystem::path& file,
                                              std::map<std::string, std::string>& inputs) {
  if (!scene.physics.surrogate) return {};
  voxel::CalibratedBody body = *scene.physics.surrogate;
  body.level = scene.level;
  const std::optional<std::filesystem::path> parameters = voxel::parameters_file(io::read_toml(file));
  const voxel::KnownErrors known = voxel::known_errors(body.parameters, parameters);
  if (known.errors) io::note_input(inputs, voxel::expected_errors_file(*parameters));
  std::vector<std::string> lines = voxel::expected_error_text(known, body, scene.design.body);
  for (const std::string& line : lines) std::cout << line << '\n';
  std::cout << std::flush;
  return lines;
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  const meshes::CommandStudy command = meshes::command_study(arguments.scene, meshes::RobotStudy::simulate, arguments.folder);
  arguments.scene = command.study;
  arguments.folder = command.folder;
  auto [scene, files] = voxel::read_scene(arguments.scene, arguments.level);
  std::map<std::string, std::string> inputs;
  for (const std::filesystem::path& file : files) io::note_input(inputs, file);  // now: they may be edited during the simulation
  if (arguments.no_pictures) scene.output.pictures = false;
  if (arguments.energy) scene.energy_ledger = true;
  if (scene.energy_ledger && scene.physics.integration.number != voxel::NumberType::float64) {
    throw io::InputError(arguments.scene.string() + ": the energy balance needs integration.number = \"float64\"");
  }
  choose_kernels(arguments);
  const io::RunFolder folder("menger-simulate", arguments.folder);
  const std::vector<std::string> expected_error = print_expected_error(scene, arguments.scene, inputs);

  io::Progress progress(scene.design.name, scene.duration_s);
  voxel::RunOptions options;
  options.kernel = arguments.kernel;
  options.stop = &io::interrupted();
  options.scene_file = arguments.scene;
  options.expected_error = expected_error;
  options.started = print_kernel_report;
  options.progress = [&](const voxel::RunProgress& now) {
    progress.update(now.time_s, io::shown(now.simulated_s_per_second, 3) + " simulated s/s");
  };
  voxel::SceneResult result = voxel::run_scene(scene, arguments.folder, options);
  folder.finish(voxel::scene_text(scene), inputs);
  progress.clear();
  if (arguments.check_dt) {
    check_step(scene, arguments.folder, options, result);
    folder.finish(voxel::scene_text(scene), inputs);  // with the time of both
  }
  print_outcome(result, arguments.folder);
  return exit_code_of(result);
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("menger-simulate", [&] { return run(argc, argv); });
}
