#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "fem/stall_map/stall_map_file.h"
#include "fem/stall_map/stall_map_output.h"
#include "fem/stall_map/stall_travel.h"
#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/study/installed_folders.h"
#include "io/study/study_text.h"
#include "io/text/whole_file.h"
#include "meshes/robot/command_study.h"

namespace {

namespace fs = std::filesystem;
using namespace menger;

struct Arguments {
  fs::path study;
  fs::path folder;
  fs::path programs = io::own_program_folder();
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  bool no_pictures = false;
};

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app("Computes which pressure a soft body reaches for each piston stroke and line resistance.", "menger stall-map");
  app.footer(
      "Example:\n  menger stall-map paper/pneumatics/stall_map.toml -o stall_map\n"
      "moves a piston that pushes closed air through a line into plena whose volume follows their pressure (a curve of\n"
      "menger inflate), until each cycle is like the one before. Writes stall_map.csv (all points), isobars.csv (strokes that\n"
      "reach a pressure), stall_map.png and manifest.json. Bodies have no inertia here; in menger locomote they have.\n"
      "With [travel] in the study a robot of calibrated voxels walks at some points of the map: travel.csv. The folder\n"
      "travel/ keeps finished walks.\n"
      "Exit codes: 0 done (points beyond the curve have the status diverged), 2 wrong input, 130 interrupted.");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    fem::StallMapStudy study;
    fem::describe(visitor, study);
  });
  app.add_option("study", arguments.study, "study file (TOML)")->required();
  app.add_option("-o,--output", arguments.folder, "folder of the results (default: the name of the study file)");
  app.add_option("-j,--jobs", arguments.jobs, "walks at the same time")->check(CLI::Range(1, 1024))->capture_default_str();
  app.add_option("--programs", arguments.programs, "folder of the other programs of menger")->capture_default_str();
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG picture");
  return io::parse_arguments(app, argc, argv);
}

void print(const fem::StallMapStudy& study, const fem::StallMap& map, double seconds) {
  const auto count = [&](io::RunStatus status) { return std::ranges::count(map.points, status, &fem::StallPoint::status); };
  std::cout << io::to_string(map.status) << ": " << map.points.size() << " points in " << io::duration_text(seconds) << ", "
            << count(io::RunStatus::diverged) << " beyond the curve of the plenum, " << count(io::RunStatus::not_converged)
            << " not settled after " << study.most_periods << " periods\n";
}

/// Computes the walks that a study asks for.
/// @return empty if the user stopped them
std::optional<std::vector<fem::StallTravel>> walk(const Arguments& arguments, const fem::StallMapStudy& study,
                                                  const fem::StallMap& map) {
  if (!study.walker) return std::vector<fem::StallTravel>{};
  const std::size_t count = fem::travel_points(study, map).size();
  io::Progress progress("travel", static_cast<double>(count));
  return fem::stall_travels(study, map,
                            {.programs = arguments.programs,
                             .runs = fs::absolute(arguments.folder) / "travel",
                             .jobs = arguments.jobs,
                             .stop = &io::interrupted(),
                             .progress = [&](std::size_t done) { progress.update(static_cast<double>(done)); }});
}

/// Writes the results. @param travels the walks; empty if the user stopped them
void write(const Arguments& arguments, const fem::StallMapStudy& study, const fem::StallMap& map,
           const std::optional<std::vector<fem::StallTravel>>& travels) {
  fem::stall_map_table(study, map).write(arguments.folder / "stall_map.csv");
  if (map.status != io::RunStatus::completed) return;
  fem::isobars_table(study, map).write(arguments.folder / "isobars.csv");
  if (travels && study.walker) fem::travel_table(map, *travels).write(arguments.folder / "travel.csv");
  if (!arguments.no_pictures) {
    const io::PictureOutcome picture =
        fem::draw_stall_map(arguments.folder / "stall_map.png", study, map, travels.value_or(std::vector<fem::StallTravel>{}));
    if (!picture.written) std::cout << "  no picture: " << picture.missing << '\n';
  }
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  menger::meshes::refuse_robot_file(arguments.study);
  const fem::StallMapStudy study = fem::read_stall_map_study(arguments.study);
  if (study.walker) static_cast<void>(io::program_in(arguments.programs, "menger-simulate"));  // before any file is overwritten
  if (arguments.folder.empty()) arguments.folder = arguments.study.stem();
  io::require_writable_folder(arguments.folder);
  const io::RunFolder folder("menger-stall-map", arguments.folder);

  auto progress = std::make_unique<io::Progress>(arguments.study.stem().string(), 1.0);
  const fem::StallMap map = fem::stall_map(study, &io::interrupted(), [&](double part) { progress->update(part); });
  progress.reset();
  std::optional<std::vector<fem::StallTravel>> travels;
  if (map.status == io::RunStatus::completed) travels = walk(arguments, study, map);
  // Only now, since walks may still find that the study is wrong: results of an earlier run stay then.
  folder.remove({"stall_map.csv", "isobars.csv", "travel.csv", "stall_map.png", "manifest.json"});
  write(arguments, study, map, travels);
  folder.finish(io::described_text(study), study.inputs);
  print(study, map, folder.seconds());
  if (!travels) std::cout << "Stopped. Finished runs are kept. Run the same command again to resume.\n";
  std::cout << "results in " << arguments.folder.string() << '\n' << std::flush;
  return travels ? io::exit_code::done : io::exit_code::interrupted;
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("menger-stall-map", [&] { return run(argc, argv); });
}
