// menger reevaluate run.sqlite --top 5: judges the best designs of a search again, by the locomotion of finite elements.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "evolution/reevaluation/reevaluation_run.h"
#include "evolution/reference/reevaluation_study.h"
#include "evolution/study/study_file.h"
#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/text/content_hash.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;
using namespace menger::evolution;

struct Arguments {
  ReevaluationRequest request;
  fs::path folder = "reevaluation";
  fs::path programs = io::own_program_folder();
  int jobs = 0;
  bool no_pictures = false;
};

constexpr const char* description =
    "Judges the best designs of a search on calibrated voxels again by finite elements: the hollow body of silicone on the\n"
    "ground, driven by the same pressure for the same time. Says how far both models agree in distance, direction and order.\n"
    "Finished runs are kept: the same command goes on where it was stopped. Results are added to the archive, too.\n\n"
    "Example:\n"
    "  menger reevaluate run.sqlite --top 5 --sample 15 --study paper/silicone/reevaluation.toml -o judged\n"
    "writes reevaluation.csv, ranking.csv, reevaluation_judge.csv, reevaluation.png, and winner/ with pictures and VTK files.";

std::optional<int> parse(Arguments& arguments, int argc, char** argv) {
  CLI::App app(description, "menger reevaluate");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    ReevaluationStudy study;
    describe(visitor, study);
  });
  app.footer("Exit codes: 0 done, 2 wrong input, 3 no design completed in both models, 130 interrupted.");
  app.add_option("archive", arguments.request.archive, "Archive of a search (menger evolve)")->required();
  app.add_option("--top", arguments.request.top, "Best distinct designs to judge")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--sample", arguments.request.sample, "Designs of the others, one from each of so many strata by fitness")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  app.add_option("-s,--study", arguments.request.file, "What decides how they are judged (TOML; default: as the search)");
  app.add_option("-o,--output", arguments.folder, "Folder of the results")->capture_default_str();
  app.add_option("-j,--jobs", arguments.jobs, "Designs at the same time (default: one per core and thread of a run)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--programs", arguments.programs, "Folder of the other programs of menger")->capture_default_str();
  app.add_flag("--no-pictures", arguments.no_pictures, "No PNG files");
  return io::parse_arguments(app, argc, argv);
}

int usual_jobs(const ReevaluationStudy& study) {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / study.elements.threads);
}

int judge(const Arguments& arguments) {
  const io::RunFolder folder("menger-reevaluate", arguments.folder);
  RunArchive archive = RunArchive::open_to_read(arguments.request.archive);
  const ReevaluationStudy study = read_reevaluation_study(arguments.request, archive);
  std::map<std::string, std::string> inputs = study.inputs;
  inputs[arguments.request.archive.string() + " (study)"] = io::content_hash(archive.study());
  io::catch_interrupts();
  std::unique_ptr<io::Progress> bar;
  ReevaluationOptions options{.programs = arguments.programs,
                              .jobs = arguments.jobs > 0 ? arguments.jobs : usual_jobs(study),
                              .stop = &io::interrupted(),
                              .pictures = !arguments.no_pictures};
  options.progress = [&](std::size_t done, std::size_t total, const std::string& name) {
    if (!bar) bar = std::make_unique<io::Progress>("reevaluate", static_cast<double>(total));
    bar->update(static_cast<double>(done), name);
  };
  const ReevaluationResult result = reevaluate(study, std::move(archive), arguments.folder, options);
  bar.reset();
  if (result.status == io::RunStatus::stopped) {
    std::cout << "Stopped; what is done is kept. The same command goes on from there." << std::endl;
    return io::exit_code_of(result.status);
  }
  folder.finish(resolved_text(study) + "# search\n" + resolved_text(study.search), inputs, study.sample_seed);
  for (const std::string& note : result.notes) std::cout << "note: " << note << "\n";
  std::cout << findings_text(study, result.findings) << result.repeated
            << " runs of finite elements made in this call\nresults in " << arguments.folder.string() << std::endl;
  return io::exit_code_of(result.status);
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("menger-reevaluate", [&]() -> int {
    Arguments arguments;
    if (const auto code = parse(arguments, argc, argv)) return *code;
    return judge(arguments);
  });
}
