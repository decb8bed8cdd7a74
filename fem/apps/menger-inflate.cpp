#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fem/inflation/inflation_convergence.h"
#include "fem/inflation/inflation_study_file.h"
#include "fem/space/parallel_program.h"
#include "fem/space/parallel_session.h"
#include "fem/space/rank_agreement.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/text/formatted.h"
#include "meshes/robot/command_study.h"

namespace {

using namespace menger;

struct Arguments {
  std::filesystem::path study;
  std::filesystem::path folder;
  int refinements = 0;
  bool restart = false;
  bool strict = false;
  bool no_pictures = false;
};

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app("Inflates the chambers of a silicone body: computes equilibrium states along a path with finite elements.",
               "menger inflate");
  app.footer(
      "Example:\n  menger inflate fem/studies/cube.toml -o cube\n"
      "writes cube/curves.csv, fields.pvd (open it in ParaView), chamber.png, pv_curve.png, displacement.png, result.toml and\n"
      "manifest.json.\n"
      "Ctrl-C keeps finished steps. Run the same command again to resume. In parallel: mpirun -n 2 menger-inflate ...\n"
      "Exit codes: 0 completed, 2 wrong input, 3 the path ended early (result.toml contains the reason), 130 interrupted.");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    fem::InflationStudy study;
    describe(visitor, study);
  });
  app.add_option("study", arguments.study, "study file, or robot.toml of menger init or its folder")->required();
  app.add_option("-o,--output", arguments.folder,
                 "folder of the results (default: the name of the study file; of a robot, its folder in results)");
  app.add_option("--refine", arguments.refinements,
                 "also run on this many finer meshes and compare; each mesh splits every element into eight")
      ->check(CLI::Range(0, 4));
  app.add_flag("--restart", arguments.restart, "start again from the beginning instead of resuming a stopped run");
  app.add_flag("--strict", arguments.strict,
               "stop with an error, instead of a warning, if a material is used outside the range of its law");
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG pictures");
  return io::parse_arguments(app, argc, argv);
}

/// Returns a length in millimetres. Lengths below a nanometre are zero except for the tolerances of the solver.
std::string millimetres(double length_m) {
  constexpr double noise_m = 1e-9;
  return io::shown(std::abs(length_m) < noise_m ? 0.0 : 1e3 * length_m);
}

void print_notes(std::span<const std::string> notes) {
  for (const std::string& note : notes) std::cout << "  " << note << '\n';
  std::cout << std::flush;
}

/// @param told number of notes that were printed when the run began
void print(const fem::InflationResult& result, std::size_t told, const std::filesystem::path& folder) {
  print_notes(std::span(result.notes).subspan(told));
  std::cout << io::to_string(result.path.status) << ": " << result.path.points.size() << " states, " << result.elements
            << " elements, " << result.unknowns << " unknowns, " << io::duration_text(result.seconds);
  if (result.resumed_points > 0) std::cout << " (" << result.resumed_points << " states resumed from an earlier run)";
  if (!result.path.reason.empty()) std::cout << "; " << result.path.reason;
  std::cout << '\n';
  for (const fem::LimitPoint& limit : result.path.limit_points) {
    std::cout << "limit point of " << result.plenum_names[limit.plenum] << ": " << io::shown(1e-3 * limit.pressure_Pa)
              << " kPa at " << io::shown(1e6 * limit.volume_m3) << " cm3" << (limit.passed ? "" : " (not passed)") << '\n';
  }
  if (!result.path.points.empty()) {
    const fem::PathPoint& first = result.path.points.front();
    const fem::PathPoint& last = result.path.points.back();
    for (std::size_t p = 0; p < std::min<std::size_t>(result.plenum_names.size(), 4); ++p) {
      std::cout << result.plenum_names[p] << ": " << io::shown(1e-3 * last.pressures_Pa[p]) << " kPa, volume "
                << io::formatted("%+.4g", 100.0 * (last.plenum_volumes_m3[p] / first.plenum_volumes_m3[p] - 1.0)) << " %\n";
    }
    for (std::size_t p = 0; p < result.point_names.size(); ++p) {
      const auto& [u, stretch] = result.observations.back()[p];
      std::cout << result.point_names[p] << ": moved (" << millimetres(u[0]) << ", " << millimetres(u[1]) << ", "
                << millimetres(u[2]) << ") mm, largest stretch " << io::shown(stretch) << '\n';
    }
  }
  std::cout << "results in " << folder.string() << '\n' << std::flush;
}

int code_of(io::RunStatus status) {
  // without Ctrl-C, only the range of a law stops a path
  return status == io::RunStatus::stopped && !io::interrupted() ? io::exit_code::numerical : io::exit_code_of(status);
}

int run(int argc, const char* const* argv, bool speaks) {
  Arguments arguments;
  std::optional<int> code;
  fem::on_every_rank(MPI_COMM_WORLD, [&] { code = parse(argc, argv, arguments); });
  if (code) return *code;
  fem::InflationStudy study;
  fem::on_every_rank(MPI_COMM_WORLD, [&] {
    const meshes::CommandStudy command = meshes::command_study(arguments.study, meshes::RobotStudy::inflate, arguments.folder);
    arguments.study = command.study;
    arguments.folder = command.folder;
    study = fem::read_inflation_study(arguments.study);
  });
  if (arguments.no_pictures) study.output.pictures = false;

  std::unique_ptr<io::Progress> progress;
  fem::InflationOptions options{.restart = arguments.restart, .strict = arguments.strict, .stop = &io::interrupted()};
  options.progress = [&](const fem::PathPoint& point, double start_s, double end_s) {
    if (!progress) progress = std::make_unique<io::Progress>(arguments.study.stem().string(), end_s - start_s);
    progress->update(point.s - start_s, io::shown(1e-3 * point.pressures_Pa.front(), 3) + " kPa");
  };
  std::vector<std::size_t> told;  // notes of each run that are printed before its path is followed
  options.begun = [&](const std::vector<std::string>& notes) {
    print_notes(notes);
    told.push_back(notes.size());
  };
  const auto begin = [&](int) { progress.reset(); };
  const bool compares = arguments.refinements > 0;
  const std::vector<fem::InflationResult> results =
      compares ? fem::run_convergence(study, arguments.refinements, arguments.folder, options, begin)
               : std::vector{fem::run_inflation(study, arguments.folder, options)};
  progress.reset();
  if (speaks) {
    for (std::size_t n = 0; n < results.size(); ++n)
      print(results[n], told[n], compares ? arguments.folder / ("refinement_" + std::to_string(n)) : arguments.folder);
  }
  return code_of(results.back().path.status);
}

}  // namespace

int main(int argc, char** argv) {
  io::hold_interrupts();
  // made before the arguments are read: it removes those for MPI
  const menger::fem::ParallelSession session(argc, argv);
  return menger::fem::run_parallel_program("menger-inflate", [&](int rank, int) { return run(argc, argv, rank == 0); });
}
