#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "fem/stall_map_file.h"
#include "fem/stall_map_output.h"
#include "io/exit_code.h"
#include "io/input_error.h"
#include "io/interrupt.h"
#include "io/manifest.h"
#include "io/program.h"
#include "io/progress.h"
#include "io/whole_file.h"

namespace {

namespace fs = std::filesystem;
using namespace menger;

struct Arguments {
  fs::path study;
  fs::path folder;
  bool no_pictures = false;
};

std::optional<int> parse(int argc, const char* const* argv, Arguments& arguments) {
  CLI::App app("Piston stroke and line resistance against the pressure that a soft body reaches.", "menger-stall-map");
  app.footer(
      "Example:\n  menger stall-map paper/pneumatics/stall_map.toml -o stall_map\n"
      "moves a piston that pushes closed air through a line into plena whose volume follows their pressure (a curve of\n"
      "menger inflate), until each cycle is like the one before. Writes stall_map.csv (all points), isobars.csv (strokes that\n"
      "reach a pressure), stall_map.png and manifest.json. Bodies have no inertia here; menger locomote has it.\n"
      "Exit codes: 0 done (points beyond the curve say diverged), 2 wrong input, 130 interrupted.");
  app.add_option("study", arguments.study, "study file (TOML)")->required();
  app.add_option("-o,--output", arguments.folder, "folder of the results (default: the name of the study file)");
  app.add_flag("--no-pictures", arguments.no_pictures, "make no PNG picture");
  return io::parse_arguments(app, argc, argv);
}

void remove_earlier_files(const fs::path& folder) {
  for (const char* name : {"stall_map.csv", "isobars.csv", "stall_map.png", "manifest.json"}) {
    std::error_code error;
    fs::remove(folder / name, error);
    if (error) throw io::InputError((folder / name).string() + ": cannot be removed: " + error.message());
  }
}

void print(const fem::StallMapStudy& study, const fem::StallMap& map, double seconds) {
  const auto count = [&](io::RunStatus status) { return std::ranges::count(map.points, status, &fem::StallPoint::status); };
  std::cout << io::to_string(map.status) << ": " << map.points.size() << " points in " << io::duration_text(seconds) << ", "
            << count(io::RunStatus::diverged) << " beyond the curve of the plenum, " << count(io::RunStatus::not_converged)
            << " not settled after " << study.most_periods << " periods\n";
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  if (const auto code = parse(argc, argv, arguments)) return *code;
  const fem::StallMapStudy study = fem::read_stall_map_study(arguments.study);
  if (arguments.folder.empty()) arguments.folder = arguments.study.stem();
  io::require_writable_folder(arguments.folder);
  remove_earlier_files(arguments.folder);

  io::catch_interrupts();
  const auto start = std::chrono::steady_clock::now();
  auto progress = std::make_unique<io::Progress>(arguments.study.stem().string(), 1.0);
  const fem::StallMap map = fem::stall_map(study, &io::interrupted(), [&](double part) { progress->update(part); });
  progress.reset();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  fem::stall_map_table(study, map).write(arguments.folder / "stall_map.csv");
  if (map.status == io::RunStatus::completed) {
    fem::isobars_table(study, map).write(arguments.folder / "isobars.csv");
    if (!arguments.no_pictures) {
      const io::PictureOutcome picture = fem::draw_stall_map(arguments.folder / "stall_map.png", study, map);
      if (!picture.written) std::cout << "  no picture: " << picture.missing << '\n';
    }
  }
  io::write_manifest(
      arguments.folder,
      {.program = "menger-stall-map", .parameters = study.text, .seed = {}, .seconds = seconds, .inputs = study.inputs});
  print(study, map, seconds);
  std::cout << "results in " << arguments.folder.string() << '\n' << std::flush;
  return map.status == io::RunStatus::stopped ? io::exit_code::interrupted : io::exit_code::done;
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("menger-stall-map", [&] { return run(argc, argv); });
}
