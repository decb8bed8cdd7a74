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

#include "evolution/archive/archive_log.h"
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
#include "io/text/toml_text.h"
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
  CLI::Option* top = app.add_option("--top", arguments.top, "Number of robots: the best that differ by more than their pose")
                         ->check(CLI::Range(1, 1000000))
                         ->capture_default_str();
  CLI::Option* champions =
      app.add_flag("--champions", arguments.champions, "The best robot of every generation instead")->excludes(top);
  app.add_option("--individuals", arguments.individuals, "These individuals instead")->excludes(champions)->excludes(top);
  app.add_option("-t,--threads", arguments.threads, "Threads; the result does not depend on them")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  return io::parse_arguments(app, argc, argv);
}

/// Returns individuals of an archive with the fitness of their body, each body once.
std::vector<FitDesign> individuals(const std::vector<std::uint64_t>& ids, const RunArchive& archive) {
  const std::vector<FitDesign> all = archive.fit_designs();
  std::vector<FitDesign> chosen;
  for (const std::uint64_t id : ids) {
    const auto fault = [&](const std::string& reason) {
      return io::InputError("--individuals " + std::to_string(id) + ": " + archive.file().string() + reason);
    };
    if (id >= archive.next_id()) throw fault(" has individuals 0 to " + std::to_string(archive.next_id() - 1));
    const Phenotype phenotype = archive.individual(id).phenotype;
    // The list has the first individual of each body; later ones have its fitness.
    const auto found = std::ranges::find(all, phenotype, &FitDesign::phenotype);
    if (found == all.end()) throw fault(" has no fitness of it");
    if (std::ranges::find(chosen, phenotype, &FitDesign::phenotype) != chosen.end()) continue;
    chosen.push_back(*found);
    chosen.back().individual = id;
  }
  return chosen;
}

std::vector<FitDesign> chosen_robots(const Arguments& arguments, const Study& search, const RunArchive& archive) {
  if (arguments.champions) return champions(view_of(archive, search));
  if (arguments.individuals.empty()) return different_robots(search, archive, arguments.top);
  return individuals(arguments.individuals, archive);
}

/// @throws io::InputError if the table would take the place of what is read
void require_other_file(const Arguments& arguments) {
  for (const fs::path& read : {arguments.archive, arguments.study}) {
    std::error_code error;  // a table that is not there yet is no other file
    if (fs::equivalent(arguments.table, read, error))
      throw io::InputError("--output " + arguments.table.string() + ": is read: choose another file");
  }
}

/// Returns which robots walk, as a table of the manifest.
std::string robots_text(const Arguments& arguments) {
  io::TomlText text;
  text.table("robots");
  if (arguments.champions) {
    text.add("champions", true);
  } else if (arguments.individuals.empty()) {
    text.add("top", arguments.top);
  } else {
    text.add("individuals", std::vector<std::int64_t>(arguments.individuals.begin(), arguments.individuals.end()));
  }
  return text.text();
}

int confirm_robots(const Arguments& arguments) {
  const auto start = Clock::now();
  require_other_file(arguments);
  const Study judge = read_study(arguments.study);
  const bool is_extended = can_be_extended(arguments.archive);
  RunArchive archive = is_extended ? RunArchive::open_to_extend(arguments.archive) : RunArchive::open_to_read(arguments.archive);
  const Study search = archived_study(archive);
  if (const std::string problem = unusable_judge(search, judge); !problem.empty())
    throw io::InputError(arguments.study.string() + ": " + problem);
  if (!archive.last_generation()) throw io::InputError(arguments.archive.string() + ": has no finished generation");
  io::require_writable_folder(arguments.table.has_parent_path() ? arguments.table.parent_path() : fs::path("."));
  const std::vector<FitDesign> robots = chosen_robots(arguments, search, archive);
  std::unique_ptr<io::Progress> bar;
  WalksAgainOptions options{.threads = arguments.threads, .stop = &io::interrupted()};
  options.progress = [&](std::size_t done, std::size_t total) {
    if (!bar) bar = std::make_unique<io::Progress>("confirmation", static_cast<double>(total));
    bar->update(static_cast<double>(done), std::to_string(done) + "/" + std::to_string(total) + " walks");
  };
  const WalksAgain asked{.study = judge, .variant = "as " + arguments.study.filename().string() + " says"};
  if (const std::size_t missing = is_extended ? 0 : missing_walk_count(asked, robots, archive); missing > 0) {
    throw io::InputError(arguments.archive.string() + ": cannot be written to, and lacks " + std::to_string(missing) +
                         " of the walks: copy it to another folder");
  }
  const io::RunStatus status = walk_again({&asked, 1}, robots, archive, options);
  bar.reset();
  if (status == io::RunStatus::stopped) {
    io::come_to_stop();
    std::cout << "Stopped. Finished walks are kept. Run the same command again to go on." << std::endl;
    return io::exit_code::interrupted;
  }
  judgement_table(judge, robots, archive).write(arguments.table);
  io::Manifest manifest{.program = "menger-confirm",
                        .parameters = resolved_text(judge) + "\n" + robots_text(arguments),
                        .seed = search.search.seed,
                        .seconds = std::chrono::duration<double>(Clock::now() - start).count(),
                        .inputs = {}};
  // The archive itself has changed: it holds these walks now.
  io::note_input(manifest.inputs, arguments.archive.string() + " (study)", archive.study());
  for (const fs::path& file : study_inputs(arguments.study)) io::note_input(manifest.inputs, file);
  // With the whole name of the table: a search may have run.manifest.json beside run.csv.
  io::write_manifest_file(fs::path(arguments.table) += ".manifest.json", manifest);
  const fs::path earlier = fs::path(arguments.table).replace_extension(".manifest.json");  // the name of former versions
  if (io::program_of_manifest(earlier) == "menger-confirm") io::remove_if_there(earlier);
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
