// menger tradeoff design.toml: how much accuracy costs how much time, on the user's own design.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "evolution/trade_off/trade_off_run.h"
#include "evolution/trade_off/trade_off_study.h"
#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/run_folder.h"
#include "io/process/study_help.h"
#include "io/study/installed_folders.h"
#include "io/text/input_error.h"
#include "meshes/robot/command_study.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;
using namespace menger::evolution;

struct Arguments {
  fs::path study;
  fs::path folder;
  fs::path programs = io::own_program_folder();
  fs::path search;
  bool no_pictures = false;
};

constexpr const char* description =
    "Runs one design at many fidelities of finite elements and voxels, and shows the cost of each accuracy.\n"
    "Finished runs are kept: run the same command again to resume, or to show the results.";

constexpr const char* example =
    "Example:\n"
    "  menger tradeoff meshes/designs/quadruped.toml -o quadruped\n"
    "  menger tradeoff paper/trade_off/study.toml -o trade\n"
    "  menger tradeoff --search paper/trade_off/search.toml -o searches\n"
    "writes tradeoff.csv, gait.csv, tradeoff.png and recommendation.txt; with searches search.csv, search.png and search.txt.\n"
    "Memory is the largest resident memory of a run's process, with its code and libraries.\n"
    "Exit codes: 0 done, 2 wrong input, 3 no run can be the reference, or no search found a champion, 130 interrupted.";

std::optional<int> parse(Arguments& arguments, int argc, char** argv) {
  CLI::App app(description, "menger tradeoff");
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    TradeStudy study;
    study.gait = GaitChoice{};  // something to run
    describe(visitor, study);
  });
  app.footer(example);
  app.add_option("study", arguments.study, "Design file, or study file with a design and what to run (TOML)");
  app.add_option("--search", arguments.search, "Study file; only its searches are run");
  app.add_option("-o,--output", arguments.folder, "Folder of the results (default: the name of the study)");
  app.add_option("--programs", arguments.programs, "Folder of the other programs of menger")->capture_default_str();
  app.add_flag("--no-pictures", arguments.no_pictures, "No PNG files");
  const auto code = io::parse_arguments(app, argc, argv);
  if (!code && arguments.study.empty() == arguments.search.empty()) {
    throw io::InputError("give either a design or study, or a study after --search");
  }
  return code;
}

TradeStudy read(const Arguments& arguments) {
  if (arguments.search.empty()) return read_trade_study(arguments.study);
  TradeStudy study = read_trade_study(arguments.search);
  if (!study.search) throw io::InputError(arguments.search.string() + ": a table [search] is missing");
  study.settling.reset();
  study.gait.reset();
  study.only_search = true;
  return study;
}

void print(const TradeStudy& study, const TradeResult& result, const fs::path& folder) {
  for (const std::string& note : result.notes) std::cout << "note: " << note << "\n";
  const auto show = [&](const std::optional<TradeTable>& table, const char* title) {
    if (table) std::cout << title << "\n" << recommendation_text(*table, study.targets);
  };
  show(result.body, "inflated:");
  show(result.gait, "walking (voxels only):");
  if (result.search) std::cout << search_text(*result.search);
  std::cout << result.repeated << " runs made in this call\nresults in " << folder.string() << std::endl;
}

int trade(Arguments& arguments) {
  menger::meshes::refuse_robot_file(arguments.search.empty() ? arguments.study : arguments.search);
  const TradeStudy study = read(arguments);
  if (arguments.folder.empty()) arguments.folder = study.file.stem();
  const io::RunFolder folder("menger-tradeoff", arguments.folder);
  std::unique_ptr<io::Progress> bar;
  double bar_total = 0.0;
  TradeOptions options{.programs = arguments.programs, .stop = &io::interrupted(), .pictures = !arguments.no_pictures};
  options.progress = [&](double done, double total, const std::string& name) {
    if (total <= 0.0) return;
    if (!bar || bar_total != total) bar = std::make_unique<io::Progress>("tradeoff", total);
    bar_total = total;
    bar->update(done, name);
  };
  options.begins = [&] { folder.begin({}); };
  const TradeResult result = run_trade_off(study, arguments.folder, options);
  bar.reset();
  if (result.status == io::RunStatus::stopped) {
    io::come_to_stop();
    std::cout << "Stopped. Finished runs are kept. Run the same command again to resume." << std::endl;
    return io::exit_code_of(result.status);
  }
  folder.finish(resolved_text(study), study.inputs);
  print(study, result, arguments.folder);
  return io::exit_code_of(result.status);
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("menger-tradeoff", [&]() -> int {
    Arguments arguments;
    if (const auto code = parse(arguments, argc, argv)) return *code;
    return trade(arguments);
  });
}
