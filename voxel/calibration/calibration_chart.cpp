#include "voxel/calibration/calibration_chart.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/picture/chart.h"
#include "io/shown/shown_column.h"
#include "io/shown/shown_quantity.h"
#include "meshes/load_cases/response_axis.h"
#include "voxel/calibration/calibration_tables.h"

namespace menger::voxel {
namespace {

/// Rows of one line: all rows of a curve over pressure, or those of one pressure over the imposed value.
std::vector<std::vector<std::size_t>> runs_of(const FittedCurve& curve) {
  std::vector<std::vector<std::size_t>> runs;
  for (std::size_t row = 0; row < curve.states.size(); ++row) {
    const bool continues = row > 0 && (curve.states[row].size() == 1 || curve.states[row][0] == curve.states[row - 1][0]);
    if (!continues) runs.emplace_back();
    runs.back().push_back(row);
  }
  return runs;
}

void add_series(io::ChartPanel& panel, const FittedCurve& curve, const std::vector<double>& residuals, std::size_t ordinate,
                const std::string& abscissa) {
  const double x_factor = io::shown_column(abscissa).factor;
  const double y_factor = io::shown_column(curve.ordinates[ordinate]).factor;
  const auto runs = runs_of(curve);
  const std::size_t rows = curve.states.size();
  for (const std::vector<std::size_t>& run : runs) {
    const io::Colour colour = io::chart_colour(panel.series.size() / 2);
    std::string name = io::shown_column(curve.ordinates[ordinate]).quantity;
    if (runs.size() > 1) name += ", " + io::kilopascals(curve.states[run.front()][0]);
    io::ChartSeries reference{.marks = io::Marks::points, .colour = colour};
    io::ChartSeries surrogate{
        .name = name, .marks = run.size() > 1 ? io::Marks::line : io::Marks::line_and_points, .colour = colour};
    for (const std::size_t row : run) {
      reference.x.push_back(x_factor * curve.states[row].back());
      reference.y.push_back(y_factor * curve.reference[ordinate][row]);
      surrogate.x.push_back(reference.x.back());
      surrogate.y.push_back(y_factor * response_at(curve, residuals, ordinate * rows + row));
    }
    panel.series.push_back(std::move(reference));
    panel.series.push_back(std::move(surrogate));
  }
}

io::ChartPanel agreement_panel(const Calibration& calibration, const std::vector<FittedCurve>& curves) {
  io::ChartPanel panel{.title = "every state",
                       .x = {.title = "reference / largest value of its curve"},
                       .y = {.title = "surrogate / largest value of its curve"},
                       .series = {},
                       .markers = {},
                       .equal_scale = true};
  std::map<meshes::LoadCaseKind, io::ChartSeries> by_kind;
  const CalibrationFit& fit = calibration.fit();
  for (std::size_t c = 0; c < fit.residuals.size(); ++c) {
    const FittedCurve& curve = curves[c];
    io::ChartSeries& series = by_kind[curve.load_case.kind];
    const std::size_t rows = curve.states.size();
    for (std::size_t n = 0; n < fit.residuals[c].size(); ++n) {
      const std::vector<double>& reference = curve.reference[n / rows];
      double largest = 0.0;
      for (const double value : reference) largest = std::max(largest, std::abs(value));
      if (largest == 0.0) continue;
      series.x.push_back(reference[n % rows] / largest);
      series.y.push_back(response_at(curve, fit.residuals[c], n) / largest);
    }
  }
  for (auto& [kind, series] : by_kind) {
    series.name = meshes::to_string(kind);
    series.marks = io::Marks::points;
    panel.series.push_back(std::move(series));
  }
  panel.series.push_back({.name = "equal in both", .x = {-1.0, 1.0}, .y = {-1.0, 1.0}, .colour = io::chart_ink});
  return panel;
}

io::ChartPanel detail_panel(const Calibration& calibration, const std::vector<FittedCurve>& curves) {
  io::ChartPanel panel{.title = "remaining error with each detail",
                       .x = {.title = "number of fitted parameters"},
                       .y = {.title = "RMS error (% of the largest value of a curve)", .lowest = 0.0},
                       .series = {},
                       .markers = {{io::ChartMarker::Direction::vertical, static_cast<double>(calibration.fit().parameter_count),
                                    "chosen number"}}};
  std::set<meshes::LoadCaseKind> kinds;
  for (const FittedCurve& curve : curves) kinds.insert(curve.load_case.kind);
  // A line joins the details that were kept, in order. Those that were not kept are points beside it.
  std::vector<const CalibrationStep*> steps;
  for (const CalibrationStep& step : calibration.steps) steps.push_back(&step);
  std::stable_sort(steps.begin(), steps.end(), [](const CalibrationStep* a, const CalibrationStep* b) {
    return a->fit.parameter_count < b->fit.parameter_count;
  });
  std::size_t number = 0;
  for (const meshes::LoadCaseKind kind : kinds) {
    const io::Colour colour = io::chart_colour(number++);
    io::ChartSeries kept{.name = std::string(meshes::to_string(kind)), .marks = io::Marks::line_and_points, .colour = colour};
    io::ChartSeries tried{.marks = io::Marks::points, .colour = colour};
    for (const CalibrationStep* step : steps) {
      const auto error = relative_error_of(kind, curves, step->fit);
      if (!error) continue;
      io::ChartSeries& series = step->is_kept ? kept : tried;
      series.x.push_back(static_cast<double>(step->fit.parameter_count));
      series.y.push_back(100.0 * *error);
    }
    for (io::ChartSeries* series : {&kept, &tried}) {
      if (!series->x.empty()) panel.series.push_back(std::move(*series));
    }
  }
  return panel;
}

}  // namespace

io::PictureOutcome draw_curve(const std::filesystem::path& file, const FittedCurve& curve, const std::vector<double>& residuals) {
  if (residuals.empty()) return {.written = false, .missing = "the surrogate has no response to " + curve.load_case.name};
  const std::string abscissa = meshes::response_columns(curve.load_case.kind)[meshes::abscissa_count(curve.load_case.kind) - 1];
  std::map<std::string, io::ChartPanel> by_unit;
  std::map<std::string, std::vector<std::string>> columns;
  for (std::size_t o = 0; o < curve.ordinates.size(); ++o) {
    const std::string unit = unit_of(curve.ordinates[o]);
    io::ChartPanel& panel = by_unit[unit];
    columns[unit].push_back(curve.ordinates[o]);
    panel.x.title = io::shown_column(abscissa).title();
    panel.y.title = meshes::response_axis_title(columns[unit]);
    add_series(panel, curve, residuals, o, abscissa);
  }
  io::Chart chart{.title = curve.load_case.name + ", " + body_text(curve.load_case) + ": reference (points), surrogate (lines)"};
  for (auto& [unit, panel] : by_unit) chart.panels.push_back(std::move(panel));
  return io::write_chart(file, chart, {.width_px = 800 * static_cast<int>(chart.panels.size()), .height_px = 700});
}

io::PictureOutcome draw_agreement(const std::filesystem::path& file, const Calibration& calibration,
                                  const std::vector<FittedCurve>& curves) {
  // Over both panels, because neither is as wide as a long list of details.
  const io::Chart chart{.title = "details fitted: " + to_string(calibration.details()),
                        .panels = {agreement_panel(calibration, curves), detail_panel(calibration, curves)}};
  return io::write_chart(file, chart, {.width_px = 2000, .height_px = 900});
}

}  // namespace menger::voxel
