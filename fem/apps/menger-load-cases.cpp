#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem/load_cases/load_case_set.h"
#include "fem/load_cases/load_case_study_file.h"
#include "fem/space/parallel_session.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/study_help.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "meshes/robot/command_study.h"

namespace {

using namespace menger;

struct Arguments {
  std::filesystem::path set;
  std::filesystem::path folder;
  std::vector<std::string> only;
  bool no_pictures = false;
  bool fields = false;
};

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app(
      "Computes the responses of hollow silicone bodies to load cases, by finite elements: the curves that `menger calibrate` "
      "fits.",
      "menger load-cases");
  app.footer(
      "Example:\n  menger load-cases fem/studies/load_cases/dragon_skin_10_1cm.toml -o curves\n"
      "writes NAME.csv, NAME.toml (its origin) and NAME.png for every case, and manifest.json.\n"
      "Finished cases are kept in curves/cache and are not computed again, also after Ctrl-C or if other parts of the set\n"
      "have changed. Several processes may share a folder: give each process its cases with --only.\n"
      "With --fields every case also gets curves/fields/NAME/fields.pvd (open it in ParaView), one step per row of its curve:\n"
      "`menger validate` then shows the worst body in both models side by side.\n"
      "Exit codes: 0 all cases completed, 2 wrong input, 3 a case ended early (its .toml contains the reason), 130 interrupted.");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    fem::LoadCaseStudy study;
    describe(visitor, study);
  });
  app.add_option("set", arguments.set, "set of load cases, or robot.toml of menger init: those that its voxels are fitted to")
      ->required();
  app.add_option("-o,--output", arguments.folder, "folder of the results (default: the name of the set file)");
  app.add_option("--only", arguments.only, "names of the cases to compute; the other cases stay as they are")->delimiter(',');
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG pictures");
  app.add_flag("--fields", arguments.fields,
               "keep displacements and stresses of every state; cached cases without them are computed again");
  return io::parse_arguments(app, argc, argv);
}

/// Keeps only the named cases. @throws io::InputError for a name that no case has
void keep_only(fem::LoadCaseStudy& study, const std::vector<std::string>& names) {
  if (names.empty()) return;
  for (const std::string& name : names) {
    const auto same = [&](const fem::CaseRequest& request) { return request.load_case.name == name; };
    if (std::none_of(study.cases.begin(), study.cases.end(), same))
      throw io::InputError("--only " + name + ": " + study.file.string() + " has no case of that name");
  }
  std::erase_if(study.cases, [&](const fem::CaseRequest& request) {
    return std::find(names.begin(), names.end(), request.load_case.name) == names.end();
  });
}

std::string shown_seconds(double seconds) {
  return seconds >= 100.0 ? io::duration_text(seconds) : io::formatted("%.1f s", seconds);
}

void print(const fem::CaseOutcome& outcome) {
  std::array<char, 160> line{};
  std::snprintf(line.data(), line.size(), "%-28s %-10s %3zu states  %-14s %s", outcome.name.c_str(),
                std::string(meshes::to_string(outcome.kind)).c_str(), outcome.states,
                std::string(io::to_string(outcome.status)).c_str(),
                outcome.from_cache ? "from the cache" : shown_seconds(outcome.seconds).c_str());
  std::cout << line.data() << '\n';
  if (!outcome.reason.empty()) std::cout << "  " << outcome.reason << '\n';
  std::cout << std::flush;
}

int exit_code_of(const std::vector<fem::CaseOutcome>& outcomes) {
  if (outcomes.back().status == io::RunStatus::stopped && io::interrupted()) return io::exit_code::interrupted;
  const auto completed = [](const fem::CaseOutcome& outcome) { return outcome.status == io::RunStatus::completed; };
  return std::all_of(outcomes.begin(), outcomes.end(), completed) ? io::exit_code::done : io::exit_code::numerical;
}

int run(int argc, const char* const* argv) {
  int rank_count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &rank_count);
  if (rank_count > 1) throw io::InputError("runs as one process: do not use mpirun; share the cases of a set with --only");
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  const meshes::CommandStudy command = meshes::command_study(arguments.set, meshes::RobotStudy::load_cases);
  arguments.set = command.study;
  if (arguments.folder.empty()) arguments.folder = command.folder;
  fem::LoadCaseStudy study = fem::read_load_case_study(arguments.set);
  keep_only(study, arguments.only);
  for (const std::string& note : study.notes) std::cout << "  " << note << '\n';

  io::Progress progress(arguments.set.stem().string(), static_cast<double>(study.cases.size()));
  fem::SetOptions options{.stop = &io::interrupted(), .pictures = !arguments.no_pictures, .fields = arguments.fields};
  options.progress = [&](std::size_t index, double part, const std::string& note) {
    progress.update(static_cast<double>(index) + part, note);
  };
  options.finished = [&](const fem::CaseOutcome& outcome) {
    progress.clear();
    print(outcome);
  };
  const std::vector<fem::CaseOutcome> outcomes = fem::run_load_case_set(study, arguments.folder, options);
  progress.clear();
  std::cout << "curves in " << arguments.folder.string() << '\n';
  return exit_code_of(outcomes);
}

}  // namespace

int main(int argc, char** argv) {
  io::hold_interrupts();
  const menger::fem::ParallelSession session(argc, argv);
  return menger::io::run_program("menger-load-cases", [&] { return run(argc, argv); });
}
