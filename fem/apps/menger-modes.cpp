#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "fem/inflation/inflation_study_file.h"
#include "fem/inflation/modes_run.h"
#include "fem/space/parallel_session.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "meshes/robot/command_study.h"

namespace {

using namespace menger;

struct Arguments {
  std::filesystem::path study;
  std::filesystem::path folder;
  fem::ModesOptions options;
  bool no_pictures = false;
};

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app(
      "Computes natural frequencies and modes of an inflated silicone body, and its response to harmonic chamber pressure.",
      "menger modes");
  app.footer(
      "Example:\n  menger modes fem/studies/cube.toml -o cube_modes\n"
      "reads a study of menger inflate and writes cube_modes/modes.csv (frequencies at the knots and stations of its path),\n"
      "modes/mode_01.vtu, ... (shapes, for ParaView), frequency_response.csv and .png, result.toml and manifest.json.\n"
      "Exit codes: 0 completed, 2 wrong input, 3 some state has no modes (result.toml contains the reason), 130 interrupted.");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    fem::InflationStudy study;
    describe(visitor, study);
  });
  app.add_option("study", arguments.study, "study file of menger inflate (TOML)")->required();
  app.add_option("-o,--output", arguments.folder, "folder of the results (default: the name of the study file and _modes)");
  app.add_option("--pressure", arguments.options.pressure_Pa, "gauge pressure of all chambers, Pa, instead of the study's path")
      ->check(CLI::Range(-1e6, 1e6));
  app.add_option("--count", arguments.options.mode_count, "number of modes (default: 6)")->check(CLI::Range(1, 200));
  app.add_option("--loss-factor", arguments.options.loss_factor,
                 "damping of the frequency response, as a fraction of the stiffness (default: 0)")
      ->check(CLI::Range(0.0, 10.0));
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG picture");
  const auto code = io::parse_arguments(app, argc, argv);
  // the range check does not reject NaN
  if (std::isnan(arguments.options.loss_factor)) throw io::InputError("--loss-factor nan: must be a number");
  if (std::isnan(arguments.options.pressure_Pa.value_or(0.0))) throw io::InputError("--pressure nan: must be a number");
  return code;
}

void print(const fem::ModesResult& result, const std::filesystem::path& folder) {
  for (const std::string& note : result.notes) std::cout << "  " << note << '\n';
  std::cout << io::to_string(result.status) << ": " << result.states.size() << " states, " << result.elements << " elements, "
            << result.unknowns << " unknowns, " << io::duration_text(result.seconds);
  if (!result.reason.empty()) std::cout << "; " << result.reason;
  std::cout << '\n';
  for (const fem::ModesState& state : result.states) {
    const auto [low, high] = std::minmax_element(state.pressures_Pa.begin(), state.pressures_Pa.end());
    std::cout << io::shown(1e-3 * *low) << (*low == *high ? "" : " to " + io::shown(1e-3 * *high)) << " kPa:";
    for (const double frequency_Hz : state.vibrations.frequencies_Hz) std::cout << ' ' << io::shown(frequency_Hz);
    std::cout << (state.vibrations.frequencies_Hz.empty() ? " " + state.vibrations.reason : " Hz") << '\n';
  }
  std::cout << "results in " << folder.string() << '\n' << std::flush;
}

int code_of(io::RunStatus status) {
  // without Ctrl-C, only the range of a law stops a path
  return status == io::RunStatus::stopped && !io::interrupted() ? io::exit_code::numerical : io::exit_code_of(status);
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  int rank_count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &rank_count);
  if (rank_count > 1) throw io::InputError("mpirun -n " + std::to_string(rank_count) + ": menger-modes runs as one process");
  menger::meshes::refuse_robot_file(arguments.study);
  fem::InflationStudy study = fem::read_inflation_study(arguments.study);
  if (arguments.no_pictures) study.output.pictures = false;
  if (arguments.folder.empty()) arguments.folder = arguments.study.stem().string() + "_modes";

  auto progress = std::make_unique<io::Progress>(arguments.study.stem().string(), 1.0);
  arguments.options.stop = &io::interrupted();
  arguments.options.progress = [&](double part, const std::string& note) { progress->update(part, note); };
  const fem::ModesResult result = fem::run_modes(study, arguments.folder, arguments.options);
  progress.reset();
  print(result, arguments.folder);
  return code_of(result.status);
}

}  // namespace

int main(int argc, char** argv) {
  io::hold_interrupts();
  // made before the arguments are read: it removes those for MPI
  const menger::fem::ParallelSession session(argc, argv);
  return io::run_program("menger-modes", [&] { return run(argc, argv); });
}
