// Table, text and picture of the results of searches of equal cost.
#include <algorithm>
#include <cmath>

#include "evolution/trade_off/trade_off_search.h"
#include "io/text/formatted.h"
#include "materials/fit/student_quantile.h"

namespace menger::evolution {
namespace {

using Score = std::optional<double> SearchRow::*;

/// The scores of the champions of one fidelity by one model.
struct Sample {
  std::vector<double> values;

  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  /// Returns the variance of the mean. Precondition: at least two values
  [[nodiscard]] double variance_of_mean() const {
    double sum = 0.0;
    for (const double value : values) sum += (value - mean()) * (value - mean());
    return sum / static_cast<double>((values.size() - 1) * values.size());
  }
};

std::vector<VoxelFidelity> fidelities_of(const SearchTrade& trade) {
  std::vector<VoxelFidelity> all;
  for (const SearchRow& row : trade.rows) {
    if (std::ranges::find(all, row.fidelity) == all.end()) all.push_back(row.fidelity);
  }
  return all;
}

Sample sample_of(const SearchTrade& trade, const VoxelFidelity& fidelity, Score score) {
  Sample sample;
  for (const SearchRow& row : trade.rows) {
    if (row.fidelity == fidelity && row.*score) sample.values.push_back(*(row.*score));
  }
  return sample;
}

std::string sample_text(const Sample& sample) {
  if (sample.values.empty()) return "no champion";
  std::string text = io::shown(sample.mean());
  if (sample.values.size() > 1) {
    text += " +- " + io::shown(std::sqrt(sample.variance_of_mean() * static_cast<double>(sample.values.size())));
  }
  return text + " (" + std::to_string(sample.values.size()) + " seeds)";
}

/// Describes whether two means differ, by Welch's test at 5 %.
std::string comparison_text(const Sample& sample, const Sample& finest) {
  if (sample.values.size() < 2 || finest.values.size() < 2) return "too few champions to compare with the finest";
  const double a = sample.variance_of_mean();
  const double b = finest.variance_of_mean();
  const double difference = sample.mean() - finest.mean();
  if (a + b == 0.0) return difference == 0.0 ? "the same as the finest" : "differs from the finest, without any spread";
  const auto freedom_of = [](const Sample& s) { return static_cast<double>(s.values.size() - 1); };
  const double freedom = (a + b) * (a + b) / (a * a / freedom_of(sample) + b * b / freedom_of(finest));
  const double least = materials::student_quantile_95(std::max(1, static_cast<int>(freedom))) * std::sqrt(a + b);
  const bool is_resolved = std::abs(difference) > least;
  const std::string start =
      is_resolved ? "significant: differs from the finest by " : "not significant: differs from the finest by ";
  return start + io::shown(difference) +
         (is_resolved ? "; the spread over seeds explains only " : "; the spread over seeds explains up to ") + io::shown(least) +
         " (Welch's test, 5 %)";
}

std::string score_text(const SearchTrade& trade, const std::string& title, Score score) {
  std::string text = title + "\n";
  const Sample finest = sample_of(trade, trade.finest, score);
  for (const VoxelFidelity& fidelity : fidelities_of(trade)) {
    const Sample sample = sample_of(trade, fidelity, score);
    text += "  " + voxel_row(fidelity, std::nullopt).label + ": " + sample_text(sample);
    text += fidelity == trade.finest ? "; the finest\n" : "; " + comparison_text(sample, finest) + "\n";
  }
  return text;
}

/// Returns a line for a search without a champion, or whose champion does not reach the pressure; otherwise an empty text.
std::string failure_text(const SearchRow& row) {
  const bool has_champion = row.status == "completed";
  if (has_champion && row.element_status == "completed") return "";
  return "  seed " + std::to_string(row.seed) + ", " + voxel_row(row.fidelity, std::nullopt).label +
         (has_champion ? ": champion, by finite elements: " + row.element_status + ", " + row.element_reason
                       : ": " + row.status + ", " + row.reason) +
         "\n";
}

io::ChartPanel score_panel(const SearchTrade& trade, const std::string& title, Score score, double factor) {
  io::ChartPanel panel;
  panel.title = "champions of searches of equal cost";
  const std::vector<VoxelFidelity> all = fidelities_of(trade);
  panel.x = {.title = "number of the fidelity (see search.txt)", .lowest = 0.5, .highest = static_cast<double>(all.size()) + 0.5};
  panel.y.title = title;
  io::ChartSeries seeds{.name = "one seed", .marks = io::Marks::points};
  io::ChartSeries means{.name = "mean", .marks = io::Marks::points, .colour = io::chart_ink};
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Sample sample = sample_of(trade, all[n], score);
    for (const double value : sample.values) {
      seeds.x.push_back(static_cast<double>(n + 1));
      seeds.y.push_back(factor * value);
    }
    if (sample.values.empty()) continue;
    means.x.push_back(static_cast<double>(n + 1));
    means.y.push_back(factor * sample.mean());
  }
  panel.series = {seeds, means};
  return panel;
}

}  // namespace

std::size_t found_count(const SearchTrade& trade) {
  return static_cast<std::size_t>(std::ranges::count(trade.rows, "completed", &SearchRow::status));
}

io::CsvTable search_csv(const SearchTrade& trade) {
  io::CsvTable table({"number", "damping", "time_step_fraction", "exclusion_depth", "seed", "generations", "voxel_steps",
                      "seconds", "champion", "own_body_lengths", "finest_body_lengths", "element_status", "volume_change",
                      "extent_change_x_m", "status", "reason", "element_reason"});
  for (const SearchRow& row : trade.rows) {
    table.add_row(row.fidelity.number, row.fidelity.damping, row.fidelity.time_step_fraction, row.fidelity.exclusion_depth,
                  row.seed, row.generations, row.voxel_steps, row.seconds, row.champion, row.own_body_lengths,
                  row.finest_body_lengths, row.element_status, row.volume_change, row.extent_change_x_m, row.status, row.reason,
                  row.element_reason);
  }
  return table;
}

std::string search_text(const SearchTrade& trade) {
  std::string text = "searches of " + io::shown(trade.voxel_steps) + " voxel steps each\n";
  const std::vector<VoxelFidelity> all = fidelities_of(trade);
  for (std::size_t n = 0; n < all.size(); ++n)
    text += "  " + std::to_string(n + 1) + ": " + voxel_row(all[n], std::nullopt).label + "\n";
  text +=
      score_text(trade, "displacement of the champions on the finest surrogate (body lengths)", &SearchRow::finest_body_lengths);
  text += score_text(trade, "growth of the champions along x, by finite elements (m)", &SearchRow::extent_change_x_m);
  const auto inflated = std::ranges::count(trade.rows, "completed", &SearchRow::element_status);
  text += std::to_string(found_count(trade)) + " of " + std::to_string(trade.rows.size()) + " searches found a champion; " +
          std::to_string(inflated) + " of these reach the pressure in finite elements\n";
  for (const SearchRow& row : trade.rows) text += failure_text(row);
  return text;
}

io::Chart search_chart(const SearchTrade& trade) {
  constexpr double mm_per_m = 1e3;
  return {
      .panels = {score_panel(trade, "displacement on the finest surrogate (body lengths)", &SearchRow::finest_body_lengths, 1.0),
                 score_panel(trade, "growth along x, by finite elements (mm)", &SearchRow::extent_change_x_m, mm_per_m)}};
}

}  // namespace menger::evolution
