#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/exit_code.h"
#include "io/formatted.h"
#include "io/input_error.h"
#include "io/interrupt.h"
#include "io/manifest.h"
#include "io/program.h"
#include "io/progress.h"
#include "materials/observables.h"
#include "voxel/instruction_sets.h"
#include "voxel/kernel_choice.h"
#include "voxel/scene_file.h"
#include "voxel/simulation_run.h"

namespace {

using namespace menger;

struct Arguments {
  std::filesystem::path scene;
  std::filesystem::path folder;
  std::optional<int> level;
  bool no_pictures = false;
  bool energy = false;
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
               "menger-simulate");
  app.footer(
      "Example:\n  menger simulate voxel/scenes/menger.toml -o walk\n"
      "writes walk/result.toml, trajectory.csv, frames.pvd (open it in ParaView), robot.png, trajectory.png and "
      "manifest.json.\n"
      "A silicone body that air drives, with calibrated parameters: voxel/scenes/silicone.toml.\n"
      "Exit codes: 0 completed, 2 wrong input, 3 diverged, 130 interrupted.");
  app.add_option("scene", arguments.scene, "scene file (TOML)")->required();
  app.add_option("-o,--output", arguments.folder, "folder of the results (default: the name of the scene file)");
  app.add_option("--level", arguments.level, "level of the fractal, instead of the scene's");
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG pictures");
  app.add_flag("--energy", arguments.energy, "keep the energy balance (slow)");
  app.add_flag("--every-term", arguments.kernel.every_term, "leave no term out of the step; gives the same bytes, slower");
  app.add_option("--instruction-set", arguments.instruction_set, "kernels to use; all give the same bytes")
      ->check(CLI::IsMember(instruction_sets()));
  return io::parse_arguments(app, argc, argv);
}

void print_kernel_report(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::cout << "  " << line << '\n';
  std::cout << std::flush;
}

std::string shown(double value, const char* format = "%.4g") { return io::formatted(format, value); }

void print_outcome(const voxel::SceneResult& result, const std::filesystem::path& folder) {
  for (const std::string& note : result.notes) std::cout << note << '\n';
  std::cout << io::to_string(result.status) << ": " << shown(result.time_s) << " s in " << result.steps << " steps of "
            << shown(result.time_step_s) << " s, " << result.voxels << " voxels, " << io::duration_text(result.seconds);
  if (result.displacement_m) {
    const double distance_m = materials::horizontal_displacement(*result.displacement_m);
    std::cout << "; moved " << shown(distance_m) << " m = " << shown(distance_m / result.body_length_m) << " body lengths";
  } else {
    std::cout << "; " << result.reason;
  }
  std::cout << "\nresults in " << folder.string() << '\n';
}

int exit_code_of(io::RunStatus status) {
  if (status == io::RunStatus::completed) return io::exit_code::done;
  return status == io::RunStatus::stopped ? io::exit_code::interrupted : io::exit_code::numerical;
}

/// The inputs are hashed here, right after they were read: they may be edited while the simulation runs.
io::Manifest manifest_of(const std::vector<std::filesystem::path>& inputs) {
  io::Manifest manifest;
  manifest.program = "menger-simulate";
  for (const auto& file : inputs) io::add_input(manifest, file);
  return manifest;
}

void choose_kernels(Arguments& arguments) {
  const voxel::InstructionSet requested = instruction_sets().at(arguments.instruction_set);
  try {
    arguments.kernel.instruction_set = voxel::resolve(requested);
  } catch (const std::invalid_argument& error) {
    throw io::InputError("--instruction-set " + arguments.instruction_set + ": " + error.what());
  }
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  auto [scene, files] = voxel::read_scene(arguments.scene, arguments.level);
  io::Manifest manifest = manifest_of(files);
  if (arguments.no_pictures) scene.output.pictures = false;
  if (arguments.energy) scene.energy_ledger = true;
  if (scene.energy_ledger && scene.physics.integration.number != voxel::NumberType::float64) {
    throw io::InputError(arguments.scene.string() + ": the energy balance needs integration.number = \"float64\"");
  }
  choose_kernels(arguments);
  manifest.parameters = voxel::scene_text(scene);
  if (arguments.folder.empty()) arguments.folder = arguments.scene.stem();

  io::catch_interrupts();
  io::Progress progress(scene.design.name, scene.duration_s);
  voxel::RunOptions options;
  options.kernel = arguments.kernel;
  options.stop = &io::interrupted();
  options.scene_file = arguments.scene;
  options.started = print_kernel_report;
  options.progress = [&](const voxel::RunProgress& now) {
    progress.update(now.time_s, shown(now.simulated_s_per_second, "%.3g") + " simulated s/s");
  };
  const voxel::SceneResult result = voxel::run_scene(scene, arguments.folder, options);
  manifest.seconds = result.seconds;
  io::write_manifest(arguments.folder, manifest);
  progress.clear();
  print_outcome(result, arguments.folder);
  return exit_code_of(result.status);
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("menger-simulate", [&] { return run(argc, argv); });
}
