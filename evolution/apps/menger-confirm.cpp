// menger confirm run.sqlite study.toml: lets robots of a search walk as another study says, and writes their scores.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/report/judgement.h"
#include "evolution/report/study_view.h"
#include "evolution/study/study_file.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/manifest.h"
#include "io/text/whole_file.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;
using namespace menger::evolution;
using Clock = std::chrono::steady_clock;

struct Arguments {
  fs::path archive;
  fs::path study;
  fs::path table = "confirmed.csv";
  std::size_t top = 3;
  bool champions = false;
  std::vector<std::uint64_t> individuals;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

constexpr const char* description =
    "Lets the best robots of a search walk as another study of a search says, on finite elements in all scenarios of its\n"
    "[robust], and writes their scores. So robots of any searches, on voxels too, are scored alike. The study's population,\n"
    "genomes and generations do not matter. Walks are kept in the archive, and the same command goes on with those that\n"
    "are missing.";

constexpr const char* example =
    "Example:\n"
    "  menger confirm run.sqlite paper/walkers/robust.toml --top 5 -o confirmed.csv\n"
    "Exit codes: 0 done, 2 wrong input, 130 interrupted.";

std::optional<int> parse(Arguments& arguments, int argc, char** argv) {
  CLI::App app(description, "menger confirm");
  app.footer(example);
  app.add_option("archive", arguments.archive, "Archive of a search")->required();
  app.add_option("study", arguments.study, "Study of a search on finite elements: how the robots walk and are scored")
      ->required();
  app.add_option("-o,--output", arguments.table, "Table of scores")->capture_default_str();
  app.add_option("--top", arguments.top, "Number of robots: the best that differ by more than their pose")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  CLI::Option* champions = app.add_flag("--champions", arguments.champions, "The best robot of every generation instead");
  app.add_option("--individuals", arguments.individuals, "These individuals instead")->excludes(champions);
  app.add_option("-t,--threads", arguments.threads, "Threads; the result does not depend on them")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  return io::parse_arguments(app, argc, argv);
}

std::vector<FitDesign> chosen_robots(const Arguments& arguments, const Study& search, const RunArchive& archive) {
  if (arguments.champions) return champions(view_of(archive, search));
  if (arguments.individuals.empty()) return different_robots(search, archive, arguments.top);
  const std::vector<FitDesign> all = archive.fit_designs();
  std::vector<FitDesign> chosen;
  for (const std::uint64_t id : arguments.individuals) {
    const auto found = std::ranges::find(all, id, &FitDesign::individual);
    if (found == all.end()) {
      throw io::InputError("--individuals " + std::to_string(id) + ": " + archive.file().string() +
                           " has no fitness of it, or an earlier individual has the same body");
    }
    chosen.push_back(*found);
  }
  return chosen;
}

int confirm_robots(const Arguments& arguments) {
  const auto start = Clock::now();
  const Study judge = read_study(arguments.study);
  RunArchive archive = RunArchive::open_to_extend(arguments.archive);
  const Study search = archived_study(archive);
  if (const std::string problem = unusable_judge(search, judge); !problem.empty())
    throw io::InputError(arguments.study.string() + ": " + problem);
  if (!archive.last_generation()) throw io::InputError(arguments.archive.string() + ": has no finished generation");
  io::require_writable_folder(arguments.table.has_parent_path() ? arguments.table.parent_path() : fs::path("."));
  const std::vector<FitDesign> robots = chosen_robots(arguments, search, archive);
  io::catch_interrupts();
  std::unique_ptr<io::Progress> bar;
  WalksAgainOptions options{.threads = arguments.threads, .stop = &io::interrupted()};
  options.progress = [&](std::size_t done, std::size_t total) {
    if (!bar) bar = std::make_unique<io::Progress>("confirmation", static_cast<double>(total));
    bar->update(static_cast<double>(done), std::to_string(done) + "/" + std::to_string(total) + " walks");
  };
  const WalksAgain asked{.study = judge, .variant = "as " + arguments.study.filename().string() + " says"};
  const io::RunStatus status = walk_again({&asked, 1}, robots, archive, options);
  bar.reset();
  if (status == io::RunStatus::stopped) {
    std::cout << "Stopped. Finished walks are kept. Run the same command again to go on." << std::endl;
    return io::exit_code::interrupted;
  }
  judgement_table(judge, robots, archive).write(arguments.table);
  io::Manifest manifest{.program = "menger-confirm",
                        .parameters = resolved_text(judge),
                        .seed = search.search.seed,
                        .seconds = std::chrono::duration<double>(Clock::now() - start).count(),
                        .inputs = {}};
  for (const fs::path& file : study_inputs(arguments.study)) io::note_input(manifest.inputs, file);
  io::write_manifest_file(fs::path(arguments.table).replace_extension(".manifest.json"), manifest);
  std::cout << robots.size() << (robots.size() == 1 ? " robot: " : " robots: ") << arguments.table.string() << std::endl;
  return io::exit_code::done;
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_program("menger-confirm", [&]() -> int {
    Arguments arguments;
    if (const auto code = parse(arguments, argc, argv)) return *code;
    return confirm_robots(arguments);
  });
}
