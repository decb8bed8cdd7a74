#include "evolution/trade_off/trade_off_chart.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "io/text/formatted.h"

namespace menger::evolution {
namespace {

constexpr const char* reference_level = "the reference's own error";
constexpr io::Colour level_colour{150, 150, 150};
constexpr double least_percent = 1e-4;
constexpr double least_s = 1e-3;
// The legend's share of the height of a panel, so that it covers no point: of its margins, and of each line.
constexpr double legend_margin = 0.03;
constexpr double legend_line = 0.04;

double drawn_percent(double error, const TradeTable& table) {
  const double least = std::max(least_percent, 10.0 * table.reference_error.value_or(0.0));
  return std::max(least, 100.0 * error);
}

/// Returns the name of the group of runs that share a colour.
std::string group_of(const TradeRow& row) {
  const auto value = [&](const std::string& column) {
    const auto found = row.fidelity.find(column);
    return found == row.fidelity.end() ? std::string() : found->second;
  };
  if (row.model != "voxels") {
    if (!value("thin_walls").empty()) return row.model + ", thin walls";
    return row.model + (value("degree") == "1" ? ", Q1/P0" : ", Q2/P1");
  }
  std::string group = "voxels, " + value("number");
  if (const std::string parts = value("voxels_per_cell"); !parts.empty()) group += ", " + parts + " per cell edge";
  return group;
}

/// Makes an axis cover whole decades, so that it does not magnify the noise of nearly equal points.
void cover_decades(io::ChartAxis& axis, const std::vector<double>& values) {
  if (values.empty()) return;
  constexpr double margin = 1.02;  // keeps points off the edge
  const auto [least, most] = std::ranges::minmax(values);
  axis.lowest = std::pow(10.0, std::floor(std::log10(least / margin)));
  axis.highest = std::pow(10.0, std::ceil(std::log10(most * margin)));
}

/// Raises the upper end of the axis of errors by what the legend takes.
void make_room_for_legend(io::ChartPanel& panel) {
  if (!panel.y.lowest || !panel.y.highest) return;
  const double share = std::min(0.6, legend_margin + legend_line * static_cast<double>(panel.series.size()));
  *panel.y.highest *= std::pow(*panel.y.highest / *panel.y.lowest, share / (1.0 - share));
}

}  // namespace

io::ChartPanel trade_panel(const TradeTable& table, const std::string& title) {
  io::ChartPanel panel;
  panel.title = title;
  panel.x = {.title = table.has_processor_times() ? "processor time (s)" : "wall time (s)", .logarithmic = true};
  panel.y = {.title = "largest error of the observables (%)", .logarithmic = true};
  std::map<std::string, std::size_t> places;
  for (const TradeRow& row : table.rows) {
    if (!row.error || !table.cost_s(row)) continue;
    const auto [place, is_new] = places.emplace(group_of(row), panel.series.size());
    if (is_new) {
      panel.series.push_back({.name = place->first, .marks = io::Marks::points, .colour = io::chart_colour(panel.series.size())});
    }
    panel.series[place->second].x.push_back(std::max(least_s, *table.cost_s(row)));
    panel.series[place->second].y.push_back(drawn_percent(*row.error, table));
  }
  io::ChartSeries front{.name = "Pareto front", .marks = io::Marks::line, .dashed = true, .colour = io::chart_ink};
  for (const std::size_t n : pareto_front(table)) {
    front.x.push_back(std::max(least_s, *table.cost_s(table.rows[n])));
    front.y.push_back(drawn_percent(*table.rows[n].error, table));
  }
  if (front.x.size() > 1) panel.series.push_back(front);  // one row is no front, and its point would lie under another
  std::vector<double> seconds;
  std::vector<double> percents;
  for (const io::ChartSeries& series : panel.series) {
    seconds.insert(seconds.end(), series.x.begin(), series.x.end());
    percents.insert(percents.end(), series.y.begin(), series.y.end());
  }
  cover_decades(panel.x, seconds);
  cover_decades(panel.y, percents);
  const auto is_raised = [&](const TradeRow& row) {
    return row.error && table.cost_s(row) && drawn_percent(*row.error, table) > 100.0 * *row.error;
  };
  const auto is_shortened = [&](const TradeRow& row) { return row.error && table.cost_s(row) && *table.cost_s(row) < least_s; };
  if (std::ranges::any_of(table.rows, is_raised))
    panel.y.title += "; smaller ones are drawn as " + io::shown(drawn_percent(0.0, table), 2);
  if (std::ranges::any_of(table.rows, is_shortened)) panel.x.title += "; shorter ones are drawn as " + io::shown(least_s);
  if (table.reference_error && panel.x.lowest &&
      panel.x.highest) {  // named in the legend: a text along the line would hide points
    const double level = drawn_percent(*table.reference_error, table);
    panel.series.push_back({.name = reference_level,
                            .x = {*panel.x.lowest, *panel.x.highest},
                            .y = {level, level},
                            .marks = io::Marks::line,
                            .colour = level_colour});
  }
  make_room_for_legend(panel);
  return panel;
}

}  // namespace menger::evolution
