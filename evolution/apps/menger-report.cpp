// menger report FOLDER: writes one page on the results of all commands in a folder.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "evolution/page/report_run.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/text/formatted.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;
using namespace menger::evolution;

struct Arguments {
  fs::path folder;
  ReportOptions options;
};

constexpr const char* description =
    "Writes one page on the results of menger's commands in a folder and its sub-folders: a verdict in words, the robot moving "
    "in\n"
    "3-D, finite elements beside the surrogate, charts, tables and where everything comes from. The page is one file that any\n"
    "browser opens without a network. Beside it stand animations (GIF) of its first four walks.";

constexpr const char* example =
    "Example:\n"
    "  menger report demo\n"
    "writes demo/report.html and demo/report.walk_1.gif to report.walk_4.gif. Those of an earlier report go first.\n"
    "Any commands may be missing; the page says what was not computed. 3-D needs Debian's package libjs-three, animations "
    "ffmpeg.\n"
    "Exit codes: 0 done, 2 wrong input or no results, 130 interrupted.";

std::optional<int> parse(Arguments& arguments, int argc, char** argv) {
  bool no_animations = false;
  CLI::App app(description, "menger report");
  app.footer(example);
  app.add_option("folder", arguments.folder, "Folder with results, or robot.toml of menger loop")->required();
  app.add_option("-o,--output", arguments.options.file, "File of the page (default: report.html in the folder)");
  app.add_flag("--no-animations", no_animations, "Make no animations (GIF) of walks; those of an earlier report stay");
  const auto code = io::parse_arguments(app, argc, argv);
  if (no_animations) arguments.options.animations = 0;
  return code;
}

int report(Arguments& arguments) {
  io::Progress bar("report", 1.0);
  arguments.options.stop = &io::interrupted();
  arguments.options.progress = [&](const std::string& doing, double share) { bar.update(share, doing); };
  const ReportResult result = write_report(arguments.folder, arguments.options);
  bar.update(1.0, "done");
  if (result.verdict.came_out.empty()) std::cout << result.verdict.headline << "\n";
  for (const std::string& line : result.verdict.came_out) std::cout << line << "\n";
  for (const Finding& finding : result.verdict.findings) std::cout << "  " << finding.text << "\n";
  for (const std::string& note : result.notes) std::cout << "note: " << note << "\n";
  for (const fs::path& animation : result.animations) std::cout << "written to " << animation.string() << "\n";
  std::cout << "written to " << result.file.string() << " (" << io::shown(1e-6 * static_cast<double>(result.bytes), 3) << " MB)"
            << std::endl;
  return result.stopped ? io::exit_code::interrupted : io::exit_code::done;
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("menger-report", [&]() -> int {
    Arguments arguments;
    if (const auto code = parse(arguments, argc, argv)) return *code;
    return report(arguments);
  });
}
