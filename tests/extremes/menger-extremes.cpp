// Runs the programs of the parts, so that no program loads the libraries of another, and joins their tables.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/study/installed_folders.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/extremes/table.h"

namespace {

using namespace menger;
namespace fs = std::filesystem;

struct Arguments {
  std::string part = "all";
  bool is_full = false;
  fs::path folder = "extremes";
};

fs::path program_of(const std::string& part) { return io::own_program_folder() / ("menger-extremes-" + part); }

/// Returns all parts, or the chosen one. @throws io::InputError naming those that were not built
std::vector<std::string> chosen_parts(const std::string& part) {
  std::vector<std::string> parts{"voxel", "fem", "calibration"};
  if (part != "all") parts = {part};
  std::string missing;
  for (const std::string& name : parts) {
    if (!fs::exists(program_of(name))) missing += (missing.empty() ? "" : ", ") + program_of(name).string();
  }
  if (!missing.empty()) throw io::InputError("--part " + part + ": not built: " + missing);
  return parts;
}

std::vector<std::string> lines_of(const fs::path& log) {
  std::istringstream text(io::read_whole(log));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Runs one part and prints its output, except for the lines of rows that end as expected. @return its exit code
int run_part_program(const std::string& part, const Arguments& arguments, io::Progress& progress, double parts_done) {
  const fs::path log = fs::absolute(arguments.folder / ("extremes-" + part + ".log"));
  io::ChildProgram child{
      .program = program_of(part), .arguments = {"-o", "."}, .folder = arguments.folder, .out = log, .err = log};
  if (arguments.is_full) child.arguments.emplace_back("--full");
  child.stop = &io::interrupted();
  child.waiting = [&](double) {
    const std::vector<std::string> lines = lines_of(log);
    progress.update(parts_done, part + ", " + (lines.empty() ? "" : lines.back()));
  };
  const io::ChildOutcome outcome = io::run_child(child);
  progress.clear();
  for (const std::string& line : lines_of(log))
    if (line.rfind(extremes::as_expected, 0) != 0) std::cout << line << '\n';
  fs::remove(log);
  if (outcome.end == io::ChildEnd::stopped) return io::exit_code::interrupted;
  if (outcome.end == io::ChildEnd::exited) return outcome.exit_code;
  std::cerr << "menger-extremes: error: " << program_of(part).string() << " ended with signal " << outcome.signal << '\n';
  return 1;
}

int run(int argc, const char* const* argv) {
  CLI::App app("Runs cases at which the models should stop being valid. Each case states its expected outcome before it runs.",
               "menger extremes");
  app.footer(
      "Example:\n  menger extremes --part voxel --full -o extremes\n"
      "writes extremes/extremes.csv and extremes.md.\n"
      "Exit codes: 0 all as expected, 2 wrong input, 3 a case did not end as expected, 130 interrupted.");
  Arguments arguments;
  app.add_option("--part", arguments.part, "which cases (default: all)")
      ->check(CLI::IsMember({"voxel", "fem", "calibration", "all"}));
  app.add_flag("--full", arguments.is_full, "run the slow cases, too");
  app.add_option("-o,--output", arguments.folder, "folder of the results (default: extremes)");
  if (const auto code = io::parse_arguments(app, argc, argv)) return *code;
  const std::vector<std::string> parts = chosen_parts(arguments.part);
  io::require_writable_folder(arguments.folder);

  io::Progress progress("extremes", static_cast<double>(parts.size()));
  int worst = io::exit_code::done;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const int code = run_part_program(parts[n], arguments, progress, static_cast<double>(n));
    if (code != io::exit_code::done && code != io::exit_code::numerical) return code;
    worst = std::max(worst, code);
  }
  extremes::join_parts(arguments.folder, parts, arguments.is_full);
  std::cout << (worst == io::exit_code::done ? "all as expected" : "not all as expected") << "; tables in "
            << arguments.folder.string() << '\n';
  return worst;
}

}  // namespace

int main(int argc, char** argv) {
  return menger::io::run_program("menger-extremes", [&] { return run(argc, argv); });
}
