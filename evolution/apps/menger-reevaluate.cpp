// menger reevaluate run.sqlite --top 5: evaluates the best designs of a search again, by the locomotion of finite elements.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "evolution/reevaluation/reevaluation_run.h"
#include "evolution/reference/reevaluation_study.h"
#include "evolution/study/study_file.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/ranks/rank_program.h"
#include "io/ranks/rank_session.h"
#include "io/ranks/rank_team.h"
#include "io/study/study_text.h"
#include "io/text/content_hash.h"
#include "io/text/toml_text.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;
using namespace menger::evolution;

struct Arguments {
  ReevaluationRequest request;
  fs::path folder = "reevaluation";
  int jobs = 0;
  bool no_pictures = false;
  double rank_patience_s = io::TeamOptions{}.patience_s;
};

constexpr const char* description =
    "Lets the best robots of a search walk again on finite elements, such as finer ones: the hollow body of silicone on the\n"
    "ground, driven by the same pressure for the same time. Compares these walks with those of the search, on calibrated voxels\n"
    "or on finite elements: distance, direction and ranking.\n"
    "Finished runs are kept: run the same command again to resume. The results are also added to the archive.";

constexpr const char* example =
    "Example:\n"
    "  menger reevaluate run.sqlite --top 5 --sample 15 --study paper/silicone/reevaluation.toml -o evaluated\n"
    "writes reevaluation.csv, ranking.csv, variants.csv, reevaluation.png, and winner/ with pictures and VTK files.\n"
    "Exit codes: 0 done, 2 wrong input, 3 no design completed in both walks, 130 interrupted.";

std::optional<int> parse(Arguments& arguments, int argc, char** argv) {
  CLI::App app(description, "menger reevaluate");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    ReevaluationStudy study;
    describe(visitor, study);
  });
  app.footer(example);
  app.add_option("archive", arguments.request.archive, "Archive of a search (menger evolve)")->required();
  app.add_option("--top", arguments.request.top, "Number of best distinct designs to re-evaluate")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--sample", arguments.request.sample,
                 "Number of designs sampled from the others, one from each of as many fitness strata")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  app.add_option("-s,--study", arguments.request.file, "Study of the re-evaluation (TOML); default: the values of the search");
  app.add_option("-o,--output", arguments.folder, "Folder of the results")->capture_default_str();
  app.add_option("-j,--jobs", arguments.jobs,
                 "Number of runs at the same time, of each process under mpirun (default: cores / threads of a run)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--rank-patience", arguments.rank_patience_s,
                 "Under mpirun: seconds without a sign of life after which the others go on without a process")
      ->check(CLI::Range(0.5, 1e6))
      ->capture_default_str();
  app.add_flag("--no-pictures", arguments.no_pictures, "No PNG files");
  return io::parse_arguments(app, argc, argv);
}

/// Returns how this process makes its runs.
ReevaluationOptions options_of(const Arguments& arguments, const ReevaluationStudy& study, io::RankSession& ranks) {
  const int usual = std::max(1, ranks.usual_threads() / study.elements.threads);
  return {.jobs = arguments.jobs > 0 ? arguments.jobs : usual,
          .stop = &io::interrupted(),
          .pictures = !arguments.no_pictures,
          .ranks = &ranks,
          .rank_patience_s = arguments.rank_patience_s};
}

/// Makes runs for the first rank until there are no more.
int walk_for_first_rank(const Arguments& arguments, io::RankSession& ranks) {
  std::optional<RunArchive> archive;
  std::optional<ReevaluationStudy> study;
  try {
    archive.emplace(RunArchive::open_to_read(arguments.request.archive));
    study = read_reevaluation_study(arguments.request, *archive);
  } catch (const std::exception& error) {  // the first rank says it, or has the same
    refuse_locomotions(ranks, error.what());
    return io::exit_code::bad_input;
  }
  walk_for_first_rank(*study, std::move(*archive), arguments.folder, options_of(arguments, *study, ranks));
  return io::exit_code::done;
}

std::string parameter_text(const ReevaluationStudy& study) {
  io::StudyTextWriter search("search");
  Study described = study.search;
  describe(search, described);
  return io::TomlText().lines(resolved_text(study)).table("search").lines(search.text()).text();
}

int reevaluate_archive(const Arguments& arguments, io::RankSession& ranks) {
  const io::RunFolder folder("menger-reevaluate", arguments.folder);
  RunArchive archive = RunArchive::open_to_read(arguments.request.archive);
  const ReevaluationStudy study = read_reevaluation_study(arguments.request, archive);
  std::map<std::string, std::string> inputs = study.inputs;
  io::note_input(inputs, arguments.request.archive.string() + " (study)", archive.study());
  std::unique_ptr<io::Progress> bar;
  ReevaluationOptions options = options_of(arguments, study, ranks);
  options.note = [&](const std::string& text) {
    bar.reset();
    std::cout << "note: " << text << std::endl;
  };
  options.progress = [&](std::size_t done, std::size_t total, const std::string& name) {
    if (!bar) bar = std::make_unique<io::Progress>("reevaluate", static_cast<double>(total));
    bar->update(static_cast<double>(done), name);
  };
  const ReevaluationResult result = reevaluate(study, std::move(archive), arguments.folder, options);
  bar.reset();
  if (result.status == io::RunStatus::stopped) {
    io::come_to_stop();
    std::cout << "Stopped. Finished runs are kept. Run the same command again to resume." << std::endl;
    return io::exit_code_of(result.status);
  }
  folder.finish(parameter_text(study), inputs, study.sample_seed);
  for (const std::string& note : result.notes) std::cout << "note: " << note << "\n";
  std::cout << findings_text(study, result.findings) << result.repeated
            << " runs of finite elements made in this call\nresults in " << arguments.folder.string() << std::endl;
  return io::exit_code_of(result.status);
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_rank_program("menger-reevaluate", [&](io::RankSession& ranks) -> int {
    Arguments arguments;
    if (const auto code = parse(arguments, argc, argv)) return *code;
    return ranks.is_first() ? reevaluate_archive(arguments, ranks) : walk_for_first_rank(arguments, ranks);
  });
}
