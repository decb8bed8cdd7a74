#include "evolution/trade_off/trade_off_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "evolution/trade_off/trade_off_body.h"
#include "evolution/trade_off/trade_off_chart.h"
#include "evolution/trade_off/trade_off_elements.h"
#include "evolution/trade_off/trade_off_reference.h"
#include "evolution/trade_off/trade_off_settled.h"
#include "evolution/trade_off/trade_off_voxels.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr double usual_pressure_Pa = 6000.0;
constexpr double part_of_limit = 0.8;

std::vector<std::string> observable_columns(const TradeStudy& study) {
  std::vector<std::string> columns;
  for (const TradeObservable observable : study.observables) columns.push_back(column_of(observable));
  return columns;
}

/// Returns the last row that has all values.
std::optional<std::size_t> finest_completed(const std::vector<TradeRow>& rows) {
  for (std::size_t n = rows.size(); n-- > 0;) {
    if (std::ranges::all_of(rows[n].values, [](const auto& value) { return value.has_value(); })) return n;
  }
  return std::nullopt;
}

/// Checks that at least one of the rows that were run was accepted.
/// @throws io::InputError with the first message if programs refused the input of all of them: then the study is wrong, not a
/// fidelity
void require_accepted(const std::vector<TradeRow>& rows) {
  const TradeRow* refused = nullptr;
  for (const TradeRow& row : rows) {
    if (row.status == "skipped") continue;
    if (!row.is_refused) return;
    if (refused == nullptr) refused = &row;
  }
  if (refused != nullptr) throw io::InputError(refused->model + ", " + refused->label + ": " + refused->reason);
}

void draw(const io::Chart& chart, const fs::path& file, TradeResult& result) {
  const auto outcome = io::write_chart(file, chart);
  if (!outcome.written) result.notes.push_back(file.filename().string() + ": not drawn: " + outcome.missing);
}

/// The chart, text and TOML that the tables share.
struct Sections {
  io::Chart chart{};
  std::string text{};
  std::string toml{};

  void add(const TradeTable& table, const std::string& title, const std::vector<double>& targets, const std::string& key) {
    chart.panels.push_back(trade_panel(table, title));
    text.append(text.empty() ? "" : "\n").append(title).append("\n").append(recommendation_text(table, targets));
    toml.append(toml.empty() ? "" : "\n").append(recommendation_toml(table, targets, key));
  }
};

/// Writes tables, recommendations and pictures into a folder, each file whole or not at all. Adds a note to the result for each
/// picture that could not be drawn.
void write_trade(const TradeStudy& study, const fs::path& folder, bool pictures, TradeResult& result) {
  Sections sections;
  if (result.body) {
    trade_csv(*result.body).write(folder / "tradeoff.csv");
    const std::string pressure = io::number_text(std::round(result.pressure_Pa) / 1e3) + " kPa";
    sections.add(*result.body, study.design.name + " at " + pressure, study.targets, "recommendation");
  }
  if (result.gait) {
    trade_csv(*result.gait).write(folder / "gait.csv");
    sections.add(*result.gait, study.design.name + " walking (voxels only)", study.targets, "gait_recommendation");
  }
  if (result.body || result.gait) {
    io::write_whole(folder / "recommendation.txt", sections.text);
    io::write_whole(folder / "recommendation.toml", sections.toml);
    if (pictures) draw(sections.chart, folder / "tradeoff.png", result);
  }
  if (result.search) {
    search_csv(*result.search).write(folder / "search.csv");
    io::write_whole(folder / "search.txt", search_text(*result.search));
    if (pictures) draw(search_chart(*result.search), folder / "search.png", result);
  }
}

class Trade {
 public:
  Trade(const TradeStudy& study, const fs::path& folder, const TradeOptions& options)
      : study_(study), folder_(folder), runner_(folder / "runs", options) {}

  TradeResult run() {
    require_programs();
    plan_elements();
    bodies_ = settled_bodies(study_);
    if (study_.pressure_Pa) require_sizes(*study_.pressure_Pa);
    io::require_writable_folder(folder_);
    if (runner_.options().begins) runner_.options().begins();
    choose_pressure();
    plan_voxels();
    if (study_.elements && !study_.only_search) run_body();
    if (study_.gait) run_gait();
    if (study_.search) run_searches();
    result_.repeated = runner_.repeated();
    if (runner_.is_stopped()) {
      result_.status = io::RunStatus::stopped;
    } else {
      write_trade(study_, folder_, runner_.options().pictures, result_);
    }
    return std::move(result_);
  }

 private:
  void require_programs() const {
    if (study_.elements || study_.search) (void)runner_.program("menger-inflate");
    if (study_.settling || study_.gait || study_.search) (void)runner_.program("menger-simulate");
    if (study_.search) (void)runner_.program("menger-evolve");
    if (study_.search) (void)runner_.program("menger-export");
  }

  /// Counts the unknowns of each fidelity. Meshes only those that may be below the limit.
  void plan_elements() {
    if (!study_.elements || study_.only_search) return;
    fidelities_ = element_fidelities(*study_.elements);
    for (const ElementFidelity& fidelity : fidelities_) {
      body_rows_.push_back(element_row(fidelity));
      body_rows_.back().values.assign(study_.observables.size(), std::nullopt);
      const double unknowns = least_unknowns(fidelity);
      if (unknowns <= study_.elements->largest_unknowns) {
        body_rows_.back().unknowns = static_cast<std::uint64_t>(unknowns);
        continue;
      }
      body_rows_.back().reason = io::number_text(std::floor(unknowns)) + " unknowns or more, but largest_unknowns is " +
                                 io::number_text(study_.elements->largest_unknowns);
    }
    if (std::ranges::none_of(body_rows_, [](const TradeRow& row) { return row.unknowns.has_value(); })) {
      throw io::InputError(study_.file.string() +
                           ": no fidelity of finite elements is left: all have more than largest_unknowns = " +
                           io::number_text(study_.elements->largest_unknowns) + " unknowns");
    }
  }

  /// Returns the number of unknowns of a mesh, or a lower bound from a coarser mesh if that bound is above the limit already.
  double least_unknowns(const ElementFidelity& fidelity) {
    if (fidelity.thin_walls) return static_cast<double>(count_elements(study_, fidelity).unknowns);
    const std::pair mesh(fidelity.degree, fidelity.elements_through_wall);
    if (const auto known = unknowns_.find(mesh); known != unknowns_.end()) return known->second;
    double least = 0.0;
    for (const auto& [coarser, unknowns] : unknowns_) {
      if (coarser.first > mesh.first || coarser.second > mesh.second) continue;
      const double finer_by = static_cast<double>(mesh.second) / coarser.second;
      least = std::max(least, unknowns * finer_by * finer_by);  // a finer mesh divides walls along at least two directions
    }
    const bool is_too_fine = least > study_.elements->largest_unknowns;
    const double count = is_too_fine ? least : static_cast<double>(count_elements(study_, fidelity).unknowns);
    unknowns_[mesh] = count;
    return count;
  }

  [[nodiscard]] io::ProgramJob element_run(std::size_t n, double pressure_Pa) const {
    return element_job(study_, fidelities_[n], pressure_Pa, runner_.program("menger-inflate"), *body_rows_[n].unknowns);
  }

  /// Sets the pressure: the stated one, or else the usual one; if the coarsest elements meet a limit before, a part of that
  /// limit.
  void choose_pressure() {
    result_.pressure_Pa = study_.pressure_Pa.value_or(usual_pressure_Pa);
    if (study_.pressure_Pa || body_rows_.empty()) return;
    const auto first = std::ranges::find_if(body_rows_, [](const TradeRow& row) { return row.unknowns.has_value(); });
    const io::ProgramJob job = element_run(static_cast<std::size_t>(first - body_rows_.begin()), usual_pressure_Pa);
    runner_.expect(job.estimated_s);
    const auto pilot = runner_.run(job);
    if (!pilot || !pilot->has_result()) return;
    const auto limit_Pa = limit_pressure_Pa(*pilot);
    if (!limit_Pa || *limit_Pa > usual_pressure_Pa) return;
    result_.pressure_Pa = part_of_limit * *limit_Pa;
    result_.notes.push_back("pressure: " + io::number_text(result_.pressure_Pa) +
                            " Pa, 0.8 of the limit pressure with the coarsest elements");
  }

  void plan_voxels() {
    for (std::size_t n = 0; n < fidelities_.size(); ++n) {
      if (body_rows_[n].unknowns) runner_.expect(element_run(n, result_.pressure_Pa).estimated_s);
    }
    if (study_.settling) {
      settling_ = voxel_fidelities(study_.voxels, study_.settling->parameters);
      require_some(settling_);
      require_sizes(result_.pressure_Pa);
      for (const VoxelFidelity& fidelity : settling_)
        runner_.expect(settling_job(study_, fidelity, result_.pressure_Pa, runner_.program("menger-simulate")).estimated_s);
    }
    if (study_.gait) {
      gait_ = voxel_fidelities(study_.voxels, {});
      require_some(gait_);
      for (const VoxelFidelity& fidelity : gait_)
        runner_.expect(gait_job(study_, fidelity, runner_.program("menger-simulate")).estimated_s);
    }
  }

  void require_sizes(double pressure_Pa) const {
    for (const auto& [file, body] : bodies_) body.require_sizes(pressure_Pa);
  }

  void require_some(const std::vector<VoxelFidelity>& fidelities) const {
    if (!fidelities.empty()) return;
    throw io::InputError(study_.file.string() + ": [voxels] leaves no fidelity: float32 needs dampings = [\"velocity\"]");
  }

  void run_body() {
    for (std::size_t n = 0; n < fidelities_.size() && !runner_.is_stopped(); ++n) {
      if (!body_rows_[n].unknowns) continue;
      runner_.fill(body_rows_[n], element_run(n, result_.pressure_Pa),
                   [&](const io::ProgramJobResult& result, TradeRow& row) { read_element_result(study_, result, row); });
    }
    TradeTable table{
        .observables = observable_columns(study_),
        .fidelity_columns = {"thin_walls", "degree", "elements_through_wall", "bulk_ratio", "force_tolerance", "number",
                             "damping", "time_step_fraction", "exclusion_depth", "voxels_per_cell", "parameters"}};
    const auto reference = finest_completed(body_rows_);
    std::vector<std::optional<double>> errors;
    if (reference) errors = element_reference_errors(fidelities_, body_rows_, *reference);
    table.rows = std::move(body_rows_);
    add_settled_rows(table);
    if (runner_.is_stopped()) return;
    require_accepted(table.rows);
    if (reference) {
      compare_with_reference(table, *reference, errors);
    } else {
      result_.status = io::RunStatus::not_converged;
      result_.notes.emplace_back("no run of finite elements reached the pressure: there is no reference");
    }
    result_.body = std::move(table);
  }

  void add_settled_rows(TradeTable& table) {
    for (const VoxelFidelity& fidelity : settling_) {
      const SettledBody& body = bodies_.at(*fidelity.parameters);
      TradeRow row = voxel_row(fidelity, body.voxels_per_cell());
      row.values.assign(study_.observables.size(), std::nullopt);
      runner_.fill(row, settling_job(study_, fidelity, result_.pressure_Pa, runner_.program("menger-simulate")),
                   [&](const io::ProgramJobResult& result, TradeRow& read) {
                     read_settling_result(study_, body, result_.pressure_Pa, result, read);
                   });
      table.rows.push_back(std::move(row));
    }
  }

  void run_gait() {
    TradeTable table{.observables = {"horizontal_displacement_m"},
                     .fidelity_columns = {"number", "damping", "time_step_fraction", "exclusion_depth"}};
    for (const VoxelFidelity& fidelity : gait_) {
      table.rows.push_back(voxel_row(fidelity, std::nullopt));
      table.rows.back().values.assign(1, std::nullopt);
      runner_.fill(table.rows.back(), gait_job(study_, fidelity, runner_.program("menger-simulate")), read_gait_result);
    }
    if (runner_.is_stopped()) return;
    require_accepted(table.rows);
    if (const auto reference = finest_completed(table.rows)) {
      const auto error = gait_reference_error(gait_, table.rows, *reference);
      compare_with_reference(table, *reference, {error});
    } else {
      result_.status = io::RunStatus::not_converged;
      result_.notes.emplace_back("no run of the gait completed: there is no reference");
    }
    result_.gait = std::move(table);
  }

  void run_searches() {
    result_.search = run_search_trade(study_, result_.pressure_Pa, runner_);
    if (runner_.is_stopped() || found_count(*result_.search) > 0) return;
    result_.status = io::RunStatus::not_converged;
    result_.notes.emplace_back("no search found a champion");
  }

  const TradeStudy& study_;
  fs::path folder_;
  TradeRunner runner_;
  TradeResult result_;
  std::vector<ElementFidelity> fidelities_;
  std::vector<TradeRow> body_rows_;
  std::map<std::pair<int, int>, double> unknowns_;  ///< of three-field elements, by degree and elements through the wall
  std::vector<VoxelFidelity> settling_;
  std::map<fs::path, SettledBody> bodies_;
  std::vector<VoxelFidelity> gait_;
};

}  // namespace

TradeResult run_trade_off(const TradeStudy& study, const fs::path& folder, const TradeOptions& options) {
  return Trade(study, folder, options).run();
}

}  // namespace menger::evolution
