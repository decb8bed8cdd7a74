#include "evolution/trade_off/trade_off_search.h"

#include <algorithm>
#include <utility>

#include "evolution/archive/run_archive.h"
#include "evolution/report/cost_table.h"
#include "evolution/report/study_view.h"
#include "evolution/study/study_file.h"
#include "evolution/trade_off/trade_off_body.h"
#include "evolution/trade_off/trade_off_elements.h"
#include "evolution/trade_off/trade_off_variant.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "meshes/design/design_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr const char* archive_name = "run.sqlite";

class SearchTrader {
 public:
  SearchTrader(const TradeStudy& study, double pressure_Pa, TradeRunner& runner)
      : study_(study), choice_(*study.search), pressure_Pa_(pressure_Pa), runner_(runner) {}

  SearchTrade run() {
    SearchTrade trade{.voxel_steps = choice_.voxel_steps, .finest = {}};
    const std::vector<VoxelFidelity> fidelities = voxel_fidelities(study_.voxels, {});
    if (fidelities.empty()) throw io::InputError(study_.file.string() + ": [voxels] leaves no fidelity for [search]");
    trade.finest = fidelities.back();
    for (const VoxelFidelity& fidelity : fidelities) {
      for (const int seed : choice_.seeds) trade.rows.push_back({.fidelity = fidelity, .seed = seed});
    }
    const double each_s = choice_.voxel_steps / usual_voxel_steps_per_s / choice_.threads;
    runner_.expect(each_s * static_cast<double>(trade.rows.size()));
    for (SearchRow& row : trade.rows) {
      if (runner_.is_stopped()) break;
      search(row, each_s);
      if (row.status == "completed") evaluate_champion(row, trade.finest);
    }
    if (std::ranges::all_of(trade.rows, [](const SearchRow& row) { return row.is_refused; }))
      throw io::InputError("every search was refused; the first: " + trade.rows.front().reason);
    return trade;
  }

 private:
  /// Returns the folder of a search. It does not depend on the number of generations, so that a longer search continues a shorter
  /// one.
  [[nodiscard]] fs::path folder_of(const io::ProgramJob& job) const {
    io::ProgramJob shared = job;
    shared.arguments.clear();
    return fs::absolute(runner_.runs() / ("search-" + io::job_hash(shared)));
  }

  [[nodiscard]] io::ProgramJob search_job(const SearchRow& row) const {
    TomlVariant variant(choice_.study);
    variant.set({"seed"}, row.seed);
    set_integration(variant, row.fidelity);
    io::ProgramJob job;
    job.name = "search: " + voxel_row(row.fidelity, std::nullopt).label + ", seed " + std::to_string(row.seed);
    job.program = runner_.program("menger-evolve");
    add_input(job, "study.toml", std::move(variant));
    job.time_limit_s = choice_.time_limit_s;
    job.kept_folder = folder_of(job);
    return job;
  }

  /// Runs a job that must give a result. @return the result, or none: then the row has the reason
  std::optional<io::ProgramJobResult> run(const io::ProgramJob& job, SearchRow& row) {
    auto result = runner_.run(job);
    if (result && result->has_result()) return result;
    row.status = result ? "failed" : "stopped";
    row.reason = result ? result->failure() : "stopped by the user";
    row.is_refused = result && result->is_refused();
    return std::nullopt;
  }

  /// Searches until the budget is spent, in calls of several generations as long as the budget is large enough.
  void search(SearchRow& row, double estimated_s) {
    constexpr double careful_part = 0.8;
    io::ProgramJob job = search_job(row);
    int goal = 0;
    for (int call = 0;; ++call) {
      job.arguments = {"study.toml", "-o", archive_name, "-t", std::to_string(choice_.threads), "-g", std::to_string(goal)};
      job.estimated_s = call == 1 ? estimated_s : 0.0;  // call 0 only shows the cost of a generation
      const auto result = run(job, row);
      if (!result) return;
      const fs::path archive = result->folder / archive_name;
      row.voxel_steps = archived_voxel_steps(archive);
      row.generations = RunArchive::open_to_read(archive).last_generation().value_or(0);
      const auto spent = static_cast<double>(row.voxel_steps);
      if (spent >= choice_.voxel_steps || row.generations >= choice_.largest_generations) break;
      const double per_generation = spent / (row.generations + 1);
      const double stride = careful_part * (choice_.voxel_steps - spent) / std::max(per_generation, 1.0);
      goal = row.generations + std::clamp(static_cast<int>(std::min(stride, 1e6)), 1, choice_.largest_generations);
      goal = std::min(goal, choice_.largest_generations);
    }
    folder_ = job.kept_folder;
    const RunArchive archive = RunArchive::open_to_read(folder_ / archive_name);
    for (int n = 0; n <= row.generations; ++n) row.seconds += archive.generation(n).seconds;
    export_champion(row);
  }

  void export_champion(SearchRow& row) {
    io::ProgramJob job;
    job.name = "champion of seed " + std::to_string(row.seed);
    job.program = runner_.program("menger-export");
    job.arguments = {archive_name, "-o", "champion", "--levels", std::to_string(study_.level), "--no-frames", "--no-pictures"};
    job.estimated_s = 0.0;
    job.kept_folder = folder_;
    job.time_limit_s = choice_.time_limit_s;
    if (!run(job, row)) return;
    if (!io::is_file(folder_ / "champion/champion.toml")) {
      row.status = "failed";
      row.reason = "no design has a fitness";
      return;
    }
    row.status = "completed";
  }

  void evaluate_champion(SearchRow& row, const VoxelFidelity& finest) {
    TradeStudy study = study_;
    try {
      study.design = meshes::read_design(folder_ / "champion/champion.toml");
      row.champion = study.design.body.digits();
      walk_champion(row, finest);
    } catch (const io::InputError& error) {  // the export is damaged
      add_reason(row, error.what());
    }
    if (!row.champion.empty()) inflate_champion(std::move(study), pressure_Pa_, runner_, row);
  }

  /// Reads the displacement of the champion on its own surrogate, and computes that on the finest one.
  void walk_champion(SearchRow& row, const VoxelFidelity& finest) {
    const fs::path level = folder_ / "champion" / ("level_" + std::to_string(study_.level));
    row.own_body_lengths = walked(level / "result.toml");
    TomlVariant scene(level / "scene.toml");
    set_integration(scene, finest);
    io::ProgramJob job;
    job.name = "champion by the finest surrogate";
    job.program = runner_.program("menger-simulate");
    job.arguments = {"scene.toml", "-o", "result", "--no-pictures"};
    add_input(job, "scene.toml", std::move(scene));
    job.time_limit_s = study_.voxels.time_limit_s;
    runner_.expect(job.estimated_s);
    const auto result = runner_.run(job);
    if (!result) return;
    if (result->has_result()) {
      row.finest_body_lengths = walked(result->folder / "result/result.toml");
    } else {
      add_reason(row, result->failure());
    }
  }

  static void add_reason(SearchRow& row, const std::string& reason) {
    row.reason += (row.reason.empty() ? "champion: " : "; champion: ") + reason;
  }

  /// Returns the displacement of a run in body lengths, if the run completed.
  static std::optional<double> walked(const fs::path& result) {
    const io::TomlTable table = io::read_toml(result);
    return table.text("status") == "completed" ? table.optional_number("horizontal_displacement_body_lengths") : std::nullopt;
  }

  const TradeStudy& study_;
  const SearchChoice& choice_;
  double pressure_Pa_;
  TradeRunner& runner_;
  fs::path folder_;  ///< folder of the present search
};

}  // namespace

void inflate_champion(TradeStudy study, double pressure_Pa, TradeRunner& runner, SearchRow& row) {
  if (!study.elements) study.elements = ElementChoice{.thin_walls = {}, .degrees = {1}, .elements_through_wall = {1}};
  study.observables = {TradeObservable::volume_change, TradeObservable::extent_x};
  const ElementFidelity fidelity = element_fidelities(*study.elements).front();
  TradeRow element = element_row(fidelity);
  element.values.assign(2, std::nullopt);
  try {
    const std::uint64_t unknowns = count_elements(study, fidelity).unknowns;
    if (static_cast<double>(unknowns) > study.elements->largest_unknowns) {
      element.reason =
          std::to_string(unknowns) + " unknowns, but largest_unknowns is " + io::number_text(study.elements->largest_unknowns);
    } else {
      const io::ProgramJob job = element_job(study, fidelity, pressure_Pa, runner.program("menger-inflate"), unknowns);
      runner.expect(job.estimated_s);
      runner.fill(element, job,
                  [&](const io::ProgramJobResult& result, TradeRow& read) { read_element_result(study, result, read); });
    }
  } catch (const io::InputError& error) {  // the champion cannot be cast
    element.status = "failed";
    element.reason = error.what();
  }
  row.element_status = element.status;
  row.element_reason = element.reason;
  row.volume_change = element.values[0];
  row.extent_change_x_m = element.values[1];
}

std::uint64_t archived_voxel_steps(const fs::path& archive_file) {
  const RunArchive archive = RunArchive::open_to_read(archive_file);
  const RunView run = view_of(archive, archived_study(archive));
  std::uint64_t sum = 0;
  for (int generation = 0; generation <= archive.last_generation().value_or(-1); ++generation)
    sum += generation_cost(run, generation).voxel_steps;
  return sum;
}

SearchTrade run_search_trade(const TradeStudy& study, double pressure_Pa, TradeRunner& runner) {
  return SearchTrader(study, pressure_Pa, runner).run();
}

}  // namespace menger::evolution
