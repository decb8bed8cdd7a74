#include "fem/locomotion/locomotion_program.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem/locomotion/locomotion_study_file.h"
#include "fem/locomotion/locomotion_sweep.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/text/formatted.h"
#include "meshes/robot/command_study.h"

namespace menger::fem {
namespace {

struct Arguments {
  std::filesystem::path study;
  std::filesystem::path folder;
  std::optional<int> threads;
  bool restart = false;
  bool quiet = false;
  bool no_pictures = false;
};

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app(
      "Moves a hollow silicone robot over the ground by the pressure in its chambers: finite elements, explicit or implicit "
      "dynamics.",
      "menger locomote");
  app.footer(
      "Example:\n  menger locomote fem/studies/locomotion.toml -o walk\n"
      "writes walk/locomotion.toml, trajectory.csv, frames.pvd (open it in ParaView), robot.png, trajectory.png and "
      "manifest.json;\na study with a table [sweep] writes one such folder for each value, sweep.csv and sweep.png.\n"
      "Ctrl-C keeps finished steps. Run the same command again to resume. A body too large for the memory of one process can\n"
      "be shared by two, with implicit dynamics: mpirun -n 2 menger-locomote ...\n"
      "Exit codes: 0 completed, 2 wrong input, 3 the run ended early (locomotion.toml contains the reason), 130 interrupted.");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    LocomotionStudy study;
    describe(visitor, study);
  });
  app.add_option("study", arguments.study, "study file, or robot.toml of menger init or its folder")->required();
  app.add_option("-o,--output", arguments.folder,
                 "folder of the results (default: the name of the study file; of a robot, its folder in results)");
  app.add_option("--threads", arguments.threads, "threads, instead of the study's; results do not depend on them")
      ->check(CLI::Range(1, 1024));
  app.add_flag("--restart", arguments.restart, "start again from the beginning instead of resuming a stopped run");
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG pictures");
  app.add_flag("-q,--quiet", arguments.quiet, "print only errors");
  return io::parse_arguments(app, argc, argv);
}

void print(const LocomotionResult& result) {
  std::cout << io::to_string(result.status) << ": " << io::shown(result.time_s) << " s in " << result.steps << " steps, "
            << result.elements << " elements, " << io::duration_text(result.seconds);
  if (const auto travel = travel_of(result)) {
    std::cout << "; moved " << io::shown(1e3 * travel->horizontal_displacement_m)
              << " mm = " << io::shown(travel->horizontal_displacement_body_lengths) << " body lengths ("
              << io::shown(travel->body_lengths_per_minute) << " per minute) towards "
              << io::formatted("%.0f", std::round(travel->direction_deg) + 0.0) << " degrees from x";
  } else {
    std::cout << "; " << result.reason;
  }
  std::cout << '\n' << std::flush;
}

int exit_code_of(const std::vector<SweepCase>& cases) {
  std::vector<io::RunStatus> parts;
  parts.reserve(cases.size());
  for (const SweepCase& one : cases) parts.push_back(one.result.status);
  return io::exit_code_of(parts);
}

/// The progress line, which shows the time that a study, or the cases of its sweep, still takes.
class StudyProgress {
 public:
  StudyProgress(const LocomotionStudy& study, bool quiet)
      : study_(study), cases_(study.sweep ? study.sweep->values.size() : 1), quiet_(quiet) {}

  void add_to(LocomotionRunOptions& options) {
    options.started = [this](double time_s) {
      start_s_ = time_s;
      const double left_s = static_cast<double>(cases_ - done_) * study_.duration_s - time_s;
      line_.reset();
      line_.emplace(study_.design.name, left_s, quiet_ ? io::ProgressStyle{} : io::terminal_progress());
    };
    options.progress = [this](double time_s) { line_->update(time_s - start_s_, io::shown(time_s, 3) + " s simulated"); };
  }
  void end_case() {
    ++done_;
    line_.reset();
  }

 private:
  const LocomotionStudy& study_;
  std::size_t cases_;
  std::size_t done_ = 0;
  bool quiet_;
  double start_s_ = 0.0;
  std::optional<io::Progress> line_;
};

int run_one(const LocomotionStudy& study, const Arguments& arguments, LocomotionRunOptions options) {
  StudyProgress progress(study, arguments.quiet);
  progress.add_to(options);
  const LocomotionResult result = run_locomotion(study, arguments.folder, options);
  progress.end_case();
  if (!arguments.quiet) {
    for (std::size_t n = study.notes.size(); n < result.notes.size(); ++n) std::cout << "  " << result.notes[n] << '\n';
    print(result);
  }
  return io::exit_code_of(result.status);
}

int run_all(const LocomotionStudy& study, const Arguments& arguments, LocomotionRunOptions options) {
  StudyProgress progress(study, arguments.quiet);
  progress.add_to(options);
  const auto ran = [&](std::size_t number, const SweepCase& done) {
    progress.end_case();
    if (arguments.quiet) return;
    std::cout << number << " of " << study.sweep->values.size();
    for (const std::string& key : study.sweep->keys) std::cout << ", " << key << " = " << done.value;
    std::cout << '\n';
    print(done.result);
  };
  return exit_code_of(run_sweep(study, arguments.folder, options, ran));
}

/// Refuses studies that run in one process only if several were started.
void refuse_processes(const LocomotionStudy& study, int process_count) {
  if (process_count == 1) return;
  const std::string file = study.file.string();
  const std::string started = ", and " + std::to_string(process_count) + " were started";
  if (!study.implicit)
    throw io::InputError(file + ": explicit dynamics runs in one process" + started + ": use --threads instead");
  if (study.sweep) throw io::InputError(file + ": sweep: its cases run one after the other in one process" + started);
}

}  // namespace

int locomotion_program(int argc, const char* const* argv, const LocomotionMethod& method) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  LocomotionStudy study;
  method.on_every_process([&] {
    const meshes::CommandStudy command = meshes::command_study(arguments.study, meshes::RobotStudy::locomote, arguments.folder);
    arguments.study = command.study;
    arguments.folder = command.folder;
    study = read_locomotion_study(arguments.study);
  });
  if (study.implicit.has_value() != method.is_implicit) return method.pass_on(arguments.study);
  if (arguments.threads) {
    if (study.implicit) throw io::InputError("--threads: " + study.file.string() + ": implicit dynamics has no threads");
    study.threads = *arguments.threads;
  }
  refuse_processes(study, method.process_count);
  if (arguments.no_pictures) study.output.pictures = false;
  if (!arguments.quiet) {
    for (const std::string& note : study.notes) std::cout << "  " << note << '\n';
    std::cout << std::flush;
  }
  if (method.help) {
    method.help(study);
    return io::exit_code::done;
  }
  const LocomotionRunOptions options{.restart = arguments.restart, .stop = &io::interrupted(), .make = method.make};
  const int code = study.sweep ? run_all(study, arguments, options) : run_one(study, arguments, options);
  if (!arguments.quiet) std::cout << "results in " << arguments.folder.string() << '\n' << std::flush;
  return code;
}

}  // namespace menger::fem
