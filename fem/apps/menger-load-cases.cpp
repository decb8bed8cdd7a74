#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fem/load_cases/load_case_set.h"
#include "fem/load_cases/load_case_study_file.h"
#include "fem/load_cases/load_cases_on_ranks.h"
#include "fem/space/parallel_session.h"
#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/study_help.h"
#include "io/ranks/mpi_start.h"
#include "io/ranks/rank_program.h"
#include "io/ranks/rank_session.h"
#include "io/ranks/rank_team.h"
#include "io/ranks/roll_call.h"
#include "io/study/installed_folders.h"
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
  double rank_patience_s = io::TeamOptions{}.patience_s;
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
      "mpirun -n 4 menger-load-cases shares the cases of a set among four processes, with the same results.\n"
      "With --fields every case also gets curves/fields/NAME/fields.pvd (open it in ParaView), one step per row of its curve:\n"
      "`menger validate` then shows the worst body in both models side by side.\n"
      "Exit codes: 0 all cases completed, 2 wrong input, 3 a case ended early (its .toml contains the reason), 130 interrupted.");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    fem::LoadCaseStudy study;
    describe(visitor, study);
  });
  app.add_option("set", arguments.set,
                 "set of load cases, or robot.toml of menger init or its folder: those that its voxels are fitted to")
      ->required();
  app.add_option("-o,--output", arguments.folder,
                 "folder of the results (default: the name of the set file; of a robot, its folder in results)");
  app.add_option("--only", arguments.only, "names of the cases to compute; the other cases stay as they are")->delimiter(',');
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG pictures");
  app.add_flag("--fields", arguments.fields,
               "keep displacements and stresses of every state; cached cases without them are computed again");
  app.add_option("--rank-patience", arguments.rank_patience_s,
                 "under mpirun: seconds without a sign of life after which the others go on without a process")
      ->check(CLI::Range(0.5, 1e6))
      ->capture_default_str();
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
  std::cout << io::formatted("%-28s %-10s %3zu states  %-14s %s\n", outcome.name.c_str(),
                             std::string(meshes::to_string(outcome.kind)).c_str(), outcome.states,
                             std::string(io::to_string(outcome.status)).c_str(),
                             outcome.from_cache ? "from the cache" : shown_seconds(outcome.seconds).c_str());
  if (!outcome.reason.empty()) std::cout << "  " << outcome.reason << '\n';
  if (!outcome.missing_picture.empty()) std::cout << "  no picture: " << outcome.missing_picture << '\n';
  std::cout << std::flush;
}

int exit_code_of(const std::vector<fem::CaseOutcome>& outcomes) {
  if (outcomes.back().status == io::RunStatus::stopped && io::interrupted()) return io::exit_code::interrupted;
  const auto completed = [](const fem::CaseOutcome& outcome) { return outcome.status == io::RunStatus::completed; };
  return std::all_of(outcomes.begin(), outcomes.end(), completed) ? io::exit_code::done : io::exit_code::numerical;
}

/// Reads the set, with the cases that are asked for alone.
fem::LoadCaseStudy study_of(Arguments& arguments) {
  const meshes::CommandStudy command = meshes::command_study(arguments.set, meshes::RobotStudy::load_cases, arguments.folder);
  arguments.set = command.study;
  arguments.folder = command.folder;
  fem::LoadCaseStudy study = fem::read_load_case_study(arguments.set);
  keep_only(study, arguments.only);
  return study;
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  fem::LoadCaseStudy study = study_of(arguments);
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

/// Returns the set as ranks compute it. @param only the names of its cases as the arguments give them
fem::RankedLoadCases ranked(Arguments& arguments) {
  fem::LoadCaseStudy study = study_of(arguments);
  fem::RankedLoadCases set{.program = io::program_in(io::own_program_folder(), "menger-load-cases"),
                           .set = arguments.set,
                           .folder = arguments.folder,
                           .cases = std::move(study.cases),
                           .material = std::move(study.material)};
  if (arguments.fields) set.options.emplace_back("--fields");
  return set;
}

/// Shares the cases of a set among the ranks of mpirun, and then writes the results as one process does.
int run_on_ranks(Arguments& arguments, io::RankSession& ranks) {
  fem::RankedLoadCases set = ranked(arguments);
  io::Progress progress(arguments.set.stem().string(), static_cast<double>(set.cases.size()));
  io::TeamOptions options{.threads = 1, .patience_s = arguments.rank_patience_s};
  options.note = [&](const std::string& text) {
    progress.clear();
    std::cout << "  " << text << std::endl;
  };
  std::cout << "  " << set.cases.size() << " cases on " << ranks.count() << " processes" << std::endl;
  const io::RunStatus status = fem::compute_on_ranks(set, ranks, options, &io::interrupted(), [&](std::size_t done) {
    progress.update(static_cast<double>(done), std::to_string(done) + " cases");
  });
  progress.clear();
  if (status == io::RunStatus::stopped) return io::exit_code::interrupted;
  if (arguments.no_pictures) set.options.emplace_back("--no-pictures");
  if (!arguments.only.empty()) {
    std::string names;
    for (const std::string& name : arguments.only) names += (names.empty() ? "" : ",") + name;
    set.options.insert(set.options.end(), {"--only", names});
  }
  return fem::finish_set(set, &io::interrupted());
}

int compute_for_first_rank(Arguments& arguments, io::RankSession& ranks) {
  std::optional<fem::RankedLoadCases> set;
  try {
    set = ranked(arguments);
  } catch (const std::exception& error) {  // the first rank says it, or has the same
    io::answer_roll(ranks, {.threads = 1, .machine = io::RankSession::machine(), .error = error.what()});
    return io::exit_code::bad_input;
  }
  fem::compute_for_first_rank(*set, ranks, {.threads = 1, .patience_s = arguments.rank_patience_s});
  return io::exit_code::done;
}

/// The program as mpirun or srun starts it.
int ranks_main(int argc, char** argv) {
  return io::run_rank_program("menger-load-cases", [&](io::RankSession& ranks) -> int {
    io::forget_mpi_start();  // the programs of the cases are none of its ranks
    Arguments arguments;
    if (const auto code = parse(argc, argv, arguments)) return *code;
    return ranks.is_first() ? run_on_ranks(arguments, ranks) : compute_for_first_rank(arguments, ranks);
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (io::is_started_as_rank()) return ranks_main(argc, argv);
  io::hold_interrupts();
  const menger::fem::ParallelSession session(argc, argv);
  return menger::io::run_program("menger-load-cases", [&] { return run(argc, argv); });
}
