// menger export run.sqlite: writes the tables of a run and simulates its champion for ParaView.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "evolution/archive/run_archive.h"
#include "evolution/report/export.h"
#include "evolution/study/study_file.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;
using namespace menger::evolution;

struct Arguments {
  fs::path archive;
  fs::path folder = "export";
  ExportOptions options;
  bool has_levels = false;  ///< whether the user gave levels
};

constexpr const char* description =
    "Writes the generations, the champion's lineage, its design file and its simulations at all scales (VTK, PNG)\n"
    "from the archive of a run. The run may still be in progress.";

constexpr const char* example =
    "Example:\n"
    "  menger export demo/run.sqlite -o demo/champion\n"
    "Exit codes: 0 done, 2 wrong input, 3 no design has a fitness, or a simulation ended early, 130 interrupted.";

std::optional<int> parse(Arguments& arguments, int argc, char** argv) {
  bool no_frames = false;
  bool no_pictures = false;
  CLI::App app(description, "menger export");
  app.footer(example);
  app.add_option("archive", arguments.archive, "Archive of a run")->required();
  app.add_option("-o,--output", arguments.folder, "Folder to write to")->capture_default_str();
  const CLI::Option* levels =
      app.add_option(
             "--levels", arguments.options.levels,
             "Levels at which the champion is simulated; a champion of finite elements walks at the level of its search alone")
          ->check(CLI::Range(1, largest_exported_level))
          ->capture_default_str();
  app.add_option("--record-interval", arguments.options.record_interval_s, "Simulated seconds between two frames")
      ->capture_default_str();
  app.add_flag("--individuals", arguments.options.individuals,
               "Write every individual with its body, its fitness and its displacement at each level (individuals.csv)");
  app.add_flag("--timings", arguments.options.timings,
               "Write the wall time of every evaluation (timings.csv), and the estimated wall time of every generation for the "
               "numbers of workers in --workers (schedule.csv)");
  app.add_option("--workers", arguments.options.workers, "Numbers of workers in schedule.csv")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_flag("--no-frames", no_frames, "No VTK files");
  app.add_flag("--no-pictures", no_pictures, "No PNG files");
  const auto code = io::parse_arguments(app, argc, argv);
  arguments.has_levels = levels->count() > 0;
  arguments.options.frames = !no_frames;
  arguments.options.pictures = !no_pictures;
  return code;
}

int export_archive(Arguments& arguments) {
  const io::RunFolder folder("menger-export", arguments.folder);
  const RunArchive archive = RunArchive::open_to_read(arguments.archive);
  const Study study = archived_study(archive);
  for (const int level : arguments.options.levels) {
    if (arguments.has_levels && uses_elements(study) && level != study.search.first_level()) {
      throw io::InputError("--levels " + std::to_string(level) + ": the search was on finite elements: must be its level, " +
                           std::to_string(study.search.first_level()));
    }
  }
  std::unique_ptr<io::Progress> bar;
  int level_shown = 0;
  arguments.options.stop = &io::interrupted();
  arguments.options.progress = [&](int level, const menger::voxel::RunProgress& progress) {
    if (level != level_shown) bar = std::make_unique<io::Progress>("level " + std::to_string(level), progress.duration_s);
    level_shown = level;
    bar->update(progress.time_s);
  };
  arguments.options.begins = [&] { folder.begin({}); };
  const ExportResult result = export_run(archive, arguments.folder, arguments.options);
  bar.reset();

  folder.finish(resolved_text(study), {{arguments.archive.string() + " (study)", io::content_hash(archive.study())}},
                study.search.seed);
  for (const std::string& note : result.notes) std::cout << "note: " << note << "\n";
  if (!result.champion) {
    std::cout << "No design has a fitness, so there is no champion. Tables of the run: "
              << (arguments.folder / "generations.csv").string() << " and the tables beside it.\n";
    return io::exit_code::numerical;
  }
  std::cout << result.champion_line << "\n" << export_text(study, result) << "Written to " << arguments.folder.string() << "\n";
  return io::exit_code_of(result.status);
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("menger-export", [&]() -> int {
    Arguments arguments;
    if (const auto code = parse(arguments, argc, argv)) return *code;
    return export_archive(arguments);
  });
}
