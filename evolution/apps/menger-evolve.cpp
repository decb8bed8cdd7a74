// menger evolve study.toml: runs or continues a search, and prints the result of each generation.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "evolution/archive/archive_files.h"
#include "evolution/archive/run_archive.h"
#include "evolution/ranks/rank_workers.h"
#include "evolution/report/confirmation.h"
#include "evolution/report/cost_table.h"
#include "evolution/report/generation_summary.h"
#include "evolution/report/refusal_table.h"
#include "evolution/report/step_check_table.h"
#include "evolution/report/study_view.h"
#include "evolution/search/search.h"
#include "evolution/study/scenarios.h"
#include "evolution/study/study_file.h"
#include "evolution/study/voxel_errors.h"
#include "fem/elements/element_kernel.h"
#include "io/device/graphics_processor.h"
#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/process/study_help.h"
#include "io/ranks/rank_program.h"
#include "io/ranks/rank_team.h"
#include "io/ranks/roll_call.h"
#include "io/shown/shown_quantity.h"
#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/manifest.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/walk_agreement.h"
#include "meshes/robot/command_study.h"
#include "voxel/scene/scene.h"

namespace {

namespace fs = std::filesystem;
namespace io = menger::io;
namespace meshes = menger::meshes;
using namespace menger::evolution;
using Clock = std::chrono::steady_clock;

struct Arguments {
  fs::path study;
  fs::path archive = "run.sqlite";
  fs::path replay;
  int threads = 0;
  double rank_patience_s = io::TeamOptions{}.patience_s;
  StudyOverrides overrides;
};

constexpr const char* description =
    "Evolves fractal robots. The archive keeps all results. Run the same command again to resume a search that was stopped,\n"
    "or to show the result of a finished one. Robots move as voxels, or with evaluation.model = \"finite_elements\" as hollow\n"
    "bodies of silicone on finite elements; with \"both\" as voxels at first, which choose those that finite elements\n"
    "evaluate. At the end of a search on finite elements its best robots walk on finer ones (evaluation.confirm); the table\n"
    "is beside the archive.";

constexpr const char* example =
    "Example:\n"
    "  menger evolve paper/demo/study.toml -o demo/run.sqlite --threads 4\n"
    "  menger export demo/run.sqlite -o demo/champion\n"
    "On a cluster, mpirun or srun starts it several times: mpirun -n 16 menger-evolve study.toml. All of them evaluate, the\n"
    "first one also searches and keeps the archive. The same results, whatever their\n"
    "number, except with population.selection = \"steady_state\".\n"
    "Exit codes: 0 done, 2 wrong input, 3 no robot has a fitness, 130 interrupted.";

std::optional<int> parse(Arguments& arguments, int argc, char** argv) {
  CLI::App app(description, "menger evolve");
  app.footer(example);
  io::add_study_help(app, [](io::StudyVisitor& visitor) {
    PresetStudy study;
    describe(visitor, study);
  });
  app.add_option("study", arguments.study, "Study file")->required();
  app.add_option("-o,--output", arguments.archive, "Archive of the run; made if it does not exist")->capture_default_str();
  app.add_option("-t,--threads", arguments.threads,
                 "Threads, of each process under mpirun; the result does not depend on them, except with population.selection = "
                 "\"steady_state\" (default: cores, shared by the "
                 "processes of a machine; for walks of finite elements on a graphics processor two for each multiprocessor)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--rank-patience", arguments.rank_patience_s,
                 "Under mpirun: seconds without a sign of life after which the others go on without a process")
      ->check(CLI::Range(0.5, 1e6))
      ->capture_default_str();
  app.add_option(
      "--replay", arguments.replay,
      "Archive of a search of the same study with population.selection = \"steady_state\": this one follows its order of "
      "results, and so becomes the same");
  app.add_option("-g,--generations", arguments.overrides.generations, "Number of generations, instead of the study's");
  app.add_option("--levels", arguments.overrides.levels, "Levels, instead of the study's, e.g. --levels 1 2");
  app.add_option("--duration", arguments.overrides.duration_s, "Simulated seconds per evaluation, instead of the study's");
  app.add_option("--seed", arguments.overrides.seed, "Seed, instead of the study's");
  app.add_option("--device", arguments.overrides.device,
                 "What evaluates bodies, instead of the study's: cpu, or cuda for a graphics processor, which takes a whole "
                 "generation at once; results of the two differ by rounding")
      ->transform(CLI::CheckedTransformer(std::map<std::string, io::Device>{{"cpu", io::Device::cpu}, {"cuda", io::Device::cuda}},
                                          CLI::ignore_case));
  return io::parse_arguments(app, argc, argv);
}

bool is_steady_state(const SearchPlan& plan) { return plan.selection_time == SelectionTime::steady_state; }

/// Counts what a search with a budget has cost.
class Expenses {
 public:
  Expenses(const RunView& run, std::optional<Budget> budget) : run_(&run), budget_(budget) {
    const int last = run.archive->last_generation().value_or(-1);
    for (int generation = 0; generation <= last; ++generation) add(generation);
  }

  /// Counts a finished generation.
  void add(int generation) {
    if (budget_) spent_ += counted_cost(generation_cost(*run_, generation), *budget_);
  }

  [[nodiscard]] bool reach_the_budget() const { return budget_ && spent_ >= budget_->element_steps; }

  /// Returns the share of the budget for people; empty without one.
  [[nodiscard]] std::string text() const {
    if (!budget_) return "";
    return io::formatted("%.0f", 100.0 * spent_ / budget_->element_steps) + " % of the budget";
  }

 private:
  const RunView* run_;
  std::optional<Budget> budget_;
  double spent_ = 0.0;  ///< element-steps
};

/// Returns the note of a progress bar. A bar at a terminal has the job as its title; whoever else is told how far this program
/// is sees the note alone.
std::string counted(const std::string& job, std::size_t done, std::size_t total, const char* what) {
  if (io::terminal_progress().out != nullptr) return std::to_string(done) + "/" + std::to_string(total) + what;
  return job + ", " + std::to_string(done) + " of " + std::to_string(total) + what;
}

/// Prints progress and results while the search runs.
class Log {
 public:
  Log(RunView run, const Expenses& expenses, int goal) : run_(std::move(run)), expenses_(expenses), goal_(goal) {}

  void generation_done(const GenerationRecord& record) {
    bar_.reset();
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const double remaining_s = elapsed_s / ++done_ * (goal_ - record.number);
    std::string time = io::duration_text(record.seconds);
    if (const std::string share = expenses_.text(); !share.empty()) {
      time += ", " + share;
    } else if (record.number < goal_) {
      time += ", " + io::duration_text(remaining_s) + " left";
    }
    std::cout << summary_line(run_, summarise_generation(run_, record.number), time) << "\n";
    if (const auto& checks = run_.plan.step_checks; checks && record.number % checks->every == 0) {
      std::cout << step_check_text(
          run_.plan, record.number,
          checked_designs(run_.plan, *run_.archive, record.number, run_.physics, run_.half_step_physics));
    }
    std::cout << std::flush;
  }

  void progress(const SearchProgress& progress) {
    if (progress.requested == 0) return;
    // The number of evaluations may grow. A new bar is needed whenever it has changed.
    if (!bar_ || total_ != progress.requested) {
      total_ = progress.requested;
      bar_ = std::make_unique<io::Progress>("generation " + std::to_string(progress.generation), static_cast<double>(total_));
    }
    const char* const what = is_steady_state(run_.plan) ? " robots" : " evaluations";
    bar_->update(static_cast<double>(progress.finished),
                 counted("generation " + std::to_string(progress.generation) + " of " +
                             (expenses_.text().empty() ? "" : "at most ") + std::to_string(goal_),
                         progress.finished, total_, what));
  }

  void screened(const ScreeningRound& round) {
    bar_.reset();
    std::cout << screening_text(round, run_.plan.screening.value()) << std::flush;
  }

  void close() { bar_.reset(); }

  /// Prints a sentence beside the progress.
  void note(const std::string& text) {
    bar_.reset();
    std::cout << "note: " << text << std::endl;
  }

 private:
  RunView run_;
  const Expenses& expenses_;
  int goal_;
  int done_ = 0;
  std::size_t total_ = 0;
  std::unique_ptr<io::Progress> bar_;
  Clock::time_point start_ = Clock::now();
};

/// Prints the generations that the archive has already; of long runs the last ones.
void print_history(const RunView& run, int last) {
  constexpr int largest_count = 20;
  const int first = std::max(0, last + 1 - largest_count);
  if (first > 0) std::cout << " ...\n";
  for (int generation = first; generation <= last; ++generation) {
    const GenerationSummary summary = summarise_generation(run, generation);
    std::cout << summary_line(run, summary, io::duration_text(summary.record.seconds)) << "\n";
  }
}

/// Prints what to expect of the voxels of the champion, which decided its fitness.
void print_expected_error(const Study& study, const VoxelErrors& errors, const meshes::Polycube& body) {
  menger::voxel::CalibratedBody calibrated = *study.physics.surrogate;
  calibrated.level = study.search.levels().back();
  for (const std::string& line : expected_error_text(errors.known, calibrated, body)) std::cout << line << "\n";
}

/// Says so if the best robot of a search does not walk.
void print_no_walk(const Study& study, double fitness) {
  const auto walked = walked_body_lengths(study, fitness);
  if (!walked || *walked >= menger::meshes::walk_limits::least_body_lengths) return;
  std::cout << "note: the champion does not walk: at this speed it moves " << io::body_lengths(*walked) << " in the "
            << io::shown(study.duration_s) << " s of an evaluation, and less than "
            << io::shown(menger::meshes::walk_limits::least_body_lengths)
            << " is no walk; give the search more generations or mutants\n";
}

/// @return whether there is a champion
bool print_champion(const RunView& run, const Study& study, int last, const std::optional<VoxelErrors>& errors) {
  const std::optional<Champion> champion = champion_of(run, study, last, confirmations(study, *run.archive));
  if (!champion) {
    std::cout
        << "No design has a fitness: every evaluation failed. The archive has the reason of each; menger export writes tables.\n";
    return false;
  }
  std::cout << champion_text(*champion) << "\n";
  const DesignSummary& design = champion->design;
  if (design.fitness) print_no_walk(study, *design.fitness);
  if (!design.outside_validity.empty())
    std::cout << "The champion is outside the range of validity of its model: " << design.outside_validity << "\n";
  if (errors && !uses_elements(study)) print_expected_error(study, *errors, design.individual.phenotype.body);
  return true;
}

/// Prints how many bodies finite elements refused, if any.
void print_refusals(const RunView& run) {
  if (!run.has_elements) return;
  const std::string text = refusal_text(refusals_of(run));
  if (!text.empty()) std::cout << "note: " << text << " (menger export writes all: refused.csv)\n";
}

/// Prints how many results are extrapolations, if there are any.
void print_validity(const RunView& run, int last) {
  std::uint64_t outside = 0;
  std::uint64_t all = 0;
  for (int generation = 0; generation <= last; ++generation) {
    outside += evaluations_outside_validity(run, generation);
    all += run.archive->generation(generation).evaluations;
  }
  if (outside == 0) return;
  std::cout << outside << " of " << all
            << " evaluations were outside the range of validity of the calibrated parameters; see generations.csv of "
            << "menger export for their generations.\n";
}

/// @param processes on this machine, each with so many threads
void require_memory(const Study& study, int threads, int processes) {
  if (estimated_memory_bytes(study, threads * processes) <= menger::voxel::machine_memory_bytes()) return;
  throw io::InputError("--threads " + std::to_string(threads) +
                       (processes > 1 ? " of " + std::to_string(processes) + " processes on a machine" : "") +
                       ": as many evaluations at once at level " + std::to_string(study.search.levels().back()) +
                       " may need more memory than this machine has");
}

void require_device(const Study& study, const Arguments& arguments) {
  if (study.device == io::Device::cpu) return;
  const std::string obstacle = io::obstacle_to_device();
  if (obstacle.empty()) return;
  const std::string device(to_string(study.device));
  const std::string asked =
      arguments.overrides.device ? "--device " + device : arguments.study.string() + ": evaluation.device = \"" + device + "\"";
  throw io::InputError(asked + ": " + obstacle);
}

/// Returns the threads of a process where none are stated. Walks on a graphics processor each wait in a thread: two for each of
/// its multiprocessors, so that there is always one that need not wait for this processor.
int usual_threads(const Study& study, const io::RankSession& ranks) {
  const auto processor = io::graphics_processor();
  if (study.device == io::Device::cpu || !uses_elements(study) || !processor) return ranks.usual_threads();
  return std::max(ranks.usual_threads(), 2 * processor->multiprocessors / ranks.count_on_machine());
}

Study study_of(const Arguments& arguments) {
  menger::meshes::refuse_robot_file(arguments.study);
  return read_study(arguments.study, arguments.overrides);
}

/// A search and what evaluates its bodies, on every rank.
struct Search {
  Search(const Arguments& arguments, const io::RankSession& ranks) : study(study_of(arguments)) {
    require_device(study, arguments);
    threads = arguments.threads > 0 ? arguments.threads : usual_threads(study, ranks);
    require_memory(study, threads, ranks.count_on_machine());
    evaluators = search_evaluators_of(study);
    half_step = half_step_evaluator_of(study);
    if (ranks.count() == 1 && !is_steady_state(study.search)) return;
    confirming = confirmation_evaluators_of(study);
    shared.add(*evaluators.evaluator);
    if (evaluators.screening) shared.add(*evaluators.screening);
    shared.add(*half_step);
    for (const std::unique_ptr<DesignEvaluator>& one : confirming) shared.add(*one);
  }

  /// Returns what must be the same on all ranks.
  [[nodiscard]] io::RankFacts facts(const io::RankSession& ranks) const {
    std::map<std::string, std::string> deciding{{"study", resolved_text(study)}, {"physics", shared.physics()}};
    // Voxels give the same bytes with every instruction set.
    if (uses_elements(study)) deciding["instruction set"] = menger::fem::best_element_kernels().instruction_set;
    return io::facts_of(ranks, threads, std::move(deciding));
  }

  Study study;
  int threads = 1;  ///< of this process
  SearchEvaluators evaluators;
  std::unique_ptr<DesignEvaluator> half_step;
  std::vector<std::unique_ptr<DesignEvaluator>> confirming;
  SharedEvaluators shared;

  /// Evaluates bodies for the first rank, or for this one.
  [[nodiscard]] io::RankWork work() const {
    return [this](const std::string& task, const std::atomic<bool>& stop, const ThreadsNow& threads_now) {
      return shared.evaluate(task, stop, threads_now);
    };
  }
};

/// Evaluates bodies for the first rank until there are no more.
int evaluate_for_first_rank(const Arguments& arguments, io::RankSession& ranks) {
  std::unique_ptr<Search> search;
  io::RankFacts facts{.threads = 1, .machine = io::RankSession::machine(), .error = {}};
  try {
    search = std::make_unique<Search>(arguments, ranks);
    facts = search->facts(ranks);
  } catch (const std::exception& error) {  // the first rank says it, or has the same
    facts.error = error.what();
  }
  io::answer_roll(ranks, facts);
  if (search) io::serve_first_rank(ranks, search->work(), {.threads = search->threads, .patience_s = arguments.rank_patience_s});
  return search ? io::exit_code::done : io::exit_code::bad_input;
}

/// Returns the table of robots on finer elements.
fs::path confirmation_file(const Arguments& arguments) { return beside_archive(arguments.archive, ".confirmed.csv"); }

fs::path manifest_file(const Arguments& arguments) { return beside_archive(arguments.archive, ".manifest.json"); }

void write_manifest(const Arguments& arguments, const io::Manifest& manifest) {
  io::write_manifest_file(manifest_file(arguments), manifest);
}

/// Whether there is an archive that a search can go on from.
bool has_archive(const Arguments& arguments) {
  std::error_code error;
  const auto size = fs::file_size(arguments.archive, error);
  return !error && size > 0;
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Lets the best robots walk on finer elements, and writes the table of what the archive has of such walks beside it.
/// @param manifest gets the time of walks that were made, and is written then
/// @return completed or stopped
io::RunStatus confirm_best(const Arguments& arguments, const Search& search, RunArchive& archive, const Workers* workers,
                           io::Manifest& manifest) {
  const Study& study = search.study;
  const auto start = Clock::now();
  bool has_walked = false;
  WalksAgainOptions options{.threads = search.threads, .stop = &io::interrupted(), .workers = workers};
  std::unique_ptr<io::Progress> bar;
  options.progress = [&](std::size_t done, std::size_t total) {
    has_walked = true;
    if (!bar) bar = std::make_unique<io::Progress>("confirmation", static_cast<double>(total));
    bar->update(static_cast<double>(done), counted("confirmation", done, total, " walks"));
  };
  const io::RunStatus status = confirm(study, archive, options);
  bar.reset();
  if (has_walked) {
    manifest.seconds += seconds_since(start);
    write_manifest(arguments, manifest);
  }
  if (status != io::RunStatus::completed) return status;
  const std::vector<Confirmation> confirmed =
      finer_fidelities(study).empty() ? std::vector<Confirmation>{} : confirmations(study, archive);
  if (confirmed.empty()) {
    io::remove_if_there(confirmation_file(arguments));  // of another archive of this name
    return status;
  }
  confirmation_table(study, confirmed).write(confirmation_file(arguments));
  std::cout << confirmation_text(study, confirmed);
  return status;
}

/// Names the scenarios of a study in its archive, which they decide.
void set_scenarios(RunArchive& archive, const Study& study, const DesignEvaluator& evaluator) {
  if (!study.robust) return;
  const std::vector<Scenario> scenarios = scenarios_of(study);
  const std::vector<std::string> physics = evaluator.scenarios();
  std::vector<ArchivedScenario> archived;
  for (std::size_t n = 0; n < scenarios.size(); ++n)
    archived.push_back({io::content_hash(physics.at(n)), scenario_text(scenarios[n])});
  archive.set_scenarios(archived);
}

/// Says on how many threads a search runs.
std::string shown_threads(int threads, const std::optional<io::RankTeam>& team, const io::RankSession& ranks) {
  if (ranks.count() > 1) return std::to_string(ranks.count()) + " processes with " + std::to_string(team->threads()) + " threads";
  return std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

/// Returns the order of results that a search is to follow; nothing if it goes its own way.
std::vector<SearchEvent> replayed_order(const Arguments& arguments, const Study& study) {
  if (arguments.replay.empty()) return {};
  const std::string given = "--replay " + arguments.replay.string() + ": ";
  if (!is_steady_state(study.search))
    throw io::InputError(given + arguments.study.string() +
                         ": population.selection = \"generational\": such a search does not depend on the order of results");
  const RunArchive archive = RunArchive::open_to_read(arguments.replay);
  if (archive.study() != identity_text(study))
    throw io::InputError(given + "is the archive of another study than " + arguments.study.string());
  std::vector<SearchEvent> order = archive.events();
  if (order.empty()) throw io::InputError(given + "has no results yet");
  return order;
}

int evolve(const Arguments& arguments, io::RankSession& ranks) {
  const Search search(arguments, ranks);
  const Study& study = search.study;
  const DesignEvaluator& evaluator = *search.evaluators.evaluator;
  std::vector<SearchEvent> replayed = replayed_order(arguments, study);
  std::function<void(const std::string&)> tell = [](const std::string& text) { std::cout << "note: " << text << std::endl; };
  std::optional<io::RankTeam> team;
  std::optional<RankWorkers> workers;
  if (ranks.count() > 1 || is_steady_state(study.search)) {
    std::vector<io::RankFacts> facts = io::call_roll(ranks, search.facts(ranks), arguments.rank_patience_s);
    if (facts.empty()) return io::exit_code::interrupted;
    team.emplace(ranks, search.work(), std::move(facts),
                 io::TeamOptions{.threads = search.threads,
                                 .patience_s = arguments.rank_patience_s,
                                 .note = [&](const std::string& text) { tell(text); }});
    workers.emplace(*team, search.shared);
  }
  const Workers* const others = workers ? &*workers : nullptr;
  io::Manifest manifest{
      .program = "menger-evolve", .parameters = resolved_text(study), .seed = study.search.seed, .seconds = 0.0, .inputs = {}};
  for (const fs::path& file : study_inputs(arguments.study)) io::note_input(manifest.inputs, file);
  if (const fs::path& silicone = study.silicone.silicone.law.file; !silicone.empty()) io::note_input(manifest.inputs, silicone);
  const std::optional<VoxelErrors> errors = voxel_errors(study, arguments.study);
  if (errors) manifest.notes = errors->text;
  if (errors && errors->table) io::note_input(manifest.inputs, *errors->table);
  const bool has_earlier_calls = has_archive(arguments);
  RunArchive archive = RunArchive::open(arguments.archive, identity_text(study), study.search.generations);
  if (has_earlier_calls)
    manifest.seconds = io::seconds_of_manifest(manifest_file(arguments), manifest.program);
  else
    io::remove_if_there(manifest_file(arguments));  // of another archive of this name
  set_scenarios(archive, study, evaluator);
  const RunView run = view_of(archive, study);

  for (const std::string& note : study_notes(study)) std::cout << "note: " << note << "\n";
  for (const std::string& line : errors ? errors->text : std::vector<std::string>{}) std::cout << line << "\n";
  const auto last = archive.last_generation();
  Expenses expenses(run, study.budget);
  const bool finished = last && (*last >= study.search.generations || expenses.reach_the_budget());
  if (finished) {
    std::cout << arguments.archive.string() << " already has generations 0 to " << *last << ": nothing to do\n";
  } else {
    std::cout << (last ? "resuming " : "writing ") << arguments.archive.string() << ": up to generation "
              << study.search.generations << (study.budget ? " or the end of the budget" : "") << ", on "
              << shown_threads(search.threads, team, ranks) << "\n";
  }
  std::cout << summary_legend(run) << '\n' << summary_header(run) << std::endl;
  if (last) print_history(run, *last);

  io::RunStatus status = io::RunStatus::completed;
  if (!finished) {
    io::remove_if_there(confirmation_file(arguments));  // of an earlier run
    Log log(run, expenses, study.search.generations);
    SearchOptions options;
    options.threads = search.threads;
    options.workers = others;
    if (workers) options.stream = &*workers;
    options.replayed = std::move(replayed);
    tell = [&](const std::string& text) { log.note(text); };
    options.stop = &io::interrupted();
    options.generation_done = [&](const GenerationRecord& record) {
      expenses.add(record.number);
      log.generation_done(record);
    };
    options.ends_with = [&](int) { return expenses.reach_the_budget(); };
    options.progress = [&](const SearchProgress& progress) { log.progress(progress); };
    options.screened = [&](const ScreeningRound& round) { log.screened(round); };
    const auto start = Clock::now();
    status = run_search(study.search, evaluator, archive, options, study.search.step_checks ? search.half_step.get() : nullptr,
                        search.evaluators.screening.get());
    log.close();
    for (const DesignEvaluator* one : {&evaluator, static_cast<const DesignEvaluator*>(search.evaluators.screening.get())}) {
      if (one != nullptr && !one->remark().empty()) std::cout << "note: " << one->remark() << "\n";
    }
    tell = [](const std::string& text) { std::cout << "note: " << text << std::endl; };
    if (status == io::RunStatus::stopped) io::come_to_stop();
    if (ranks.count() > 1) tell(team->shares());
    manifest.seconds += seconds_since(start);
    write_manifest(arguments, manifest);
  }
  if (status == io::RunStatus::completed) status = confirm_best(arguments, search, archive, others, manifest);
  if (status == io::RunStatus::stopped) {
    std::cout << "Stopped. " << (is_steady_state(study.search) ? "Robots that ended" : "Finished evaluations")
              << " are kept. Run the same command again to resume." << std::endl;
    return io::exit_code::interrupted;
  }
  print_refusals(run);
  const bool has_champion = print_champion(run, study, *archive.last_generation(), errors);
  print_validity(run, *archive.last_generation());
  std::cout << "Next: menger export " << arguments.archive.string() << "\n";
  if (uses_elements(study))
    std::cout << "      menger reevaluate " << arguments.archive.string() << " --top 5   (on finer elements)\n";
  return has_champion ? io::exit_code::done : io::exit_code::numerical;
}

}  // namespace

int main(int argc, char** argv) {
  return io::run_rank_program("menger-evolve", [&](io::RankSession& ranks) -> int {
    Arguments arguments;
    if (const auto code = parse(arguments, argc, argv)) return *code;
    return ranks.is_first() ? evolve(arguments, ranks) : evaluate_for_first_rank(arguments, ranks);
  });
}
