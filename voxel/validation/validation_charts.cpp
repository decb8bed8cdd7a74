#include "voxel/validation/validation_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/picture/chart.h"
#include "io/shown/shown_column.h"
#include "io/shown/shown_quantity.h"
#include "meshes/load_cases/response_axis.h"
#include "voxel/validation/validation_summary.h"

namespace menger::voxel {

namespace {

constexpr int panel_width_px = 900;
constexpr int panel_height_px = 850;

/// Whether an error is shown: of each kind those inside the range of validity, or all where nothing of it lies inside.
class Shown {
 public:
  explicit Shown(const std::vector<CurveComparison>& comparisons) {
    for (const CurveComparison& comparison : comparisons)
      for (const ObservableError& error : comparison.errors)
        if (std::isfinite(error.error)) (error.validity == Validity::inside ? inside_ : outside_).at(of(error.kind)) = true;
  }
  [[nodiscard]] bool operator()(const ObservableError& error) const {
    return std::isfinite(error.error) && (error.validity == Validity::inside || !inside_.at(of(error.kind)));
  }
  [[nodiscard]] bool is_outside(ObservableKind kind) const { return outside_.at(of(kind)) && !inside_.at(of(kind)); }
  [[nodiscard]] bool is_all_outside() const {
    return std::ranges::find(outside_, true) != outside_.end() && std::ranges::find(inside_, true) == inside_.end();
  }

 private:
  static std::size_t of(ObservableKind kind) { return static_cast<std::size_t>(kind); }
  std::array<bool, observable_kind_count> inside_{};
  std::array<bool, observable_kind_count> outside_{};
};

io::ChartPanel spread_panel(const std::vector<CurveComparison>& comparisons, const Shown& is_shown, double aim) {
  io::ChartPanel panel{.title = "cumulative distribution of errors",
                       .x = {.title = "error (% of the largest value in the curve)", .lowest = 0.0},
                       .y = {.title = "values with at most this error (%)", .lowest = 0.0, .highest = 100.0},
                       .series = {},
                       .markers = {{io::ChartMarker::Direction::vertical, 100.0 * aim, "aim"}}};
  for (std::size_t kind = 0; kind < observable_kind_count; ++kind) {
    std::vector<double> magnitudes;
    for (const CurveComparison& comparison : comparisons) {
      for (const ObservableError& error : comparison.errors) {
        if (is_shown(error) && error.kind == static_cast<ObservableKind>(kind))
          magnitudes.push_back(100.0 * std::abs(error.error));
      }
    }
    if (magnitudes.empty()) continue;
    std::sort(magnitudes.begin(), magnitudes.end());
    io::ChartSeries series{.name = std::string(to_string(static_cast<ObservableKind>(kind))), .colour = io::chart_colour(kind)};
    for (std::size_t i = 0; i < magnitudes.size(); ++i) {
      series.x.push_back(magnitudes[i]);
      series.y.push_back(100.0 * static_cast<double>(i + 1) / static_cast<double>(magnitudes.size()));
    }
    if (magnitudes.size() == 1) series.marks = io::Marks::points;
    panel.series.push_back(series);
  }
  return panel;
}

io::ChartPanel pressure_panel(const std::vector<CurveComparison>& comparisons, const Shown& is_shown, ObservableKind kind,
                              double aim) {
  io::ChartPanel panel{
      .title = "error in " + std::string(to_string(kind)) + (is_shown.is_outside(kind) ? ", outside the range of validity" : ""),
      .x = {.title = "pressure (kPa)"},
      .y = {.title = "error (% of the largest value in the curve)"},
      .series = {},
      .markers = {}};
  const std::vector<std::string> bodies = bodies_of(comparisons);
  double largest = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    io::ChartSeries series{.name = bodies[b], .marks = io::Marks::points, .colour = io::chart_colour(b)};
    for (const CurveComparison& comparison : comparisons) {
      if (comparison.body != bodies[b]) continue;
      for (const ObservableError& error : comparison.errors) {
        if (!is_shown(error) || error.kind != kind) continue;
        series.x.push_back(1e-3 * error.pressure_Pa);
        series.y.push_back(100.0 * error.error);
        largest = std::max(largest, std::abs(error.error));
      }
    }
    if (!series.x.empty()) panel.series.push_back(series);
  }
  // Markers must lie inside the axis.
  const double end = 110.0 * std::max(largest, aim);
  panel.y.lowest = -end;
  panel.y.highest = end;
  for (const double at : {-aim, aim})
    panel.markers.push_back({io::ChartMarker::Direction::horizontal, 100.0 * at, at > 0.0 ? "aim" : ""});
  return panel;
}

/// One line of a panel: some rows of a column, for both models.
struct CurvePart {
  std::string name;
  std::size_t column = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// A column as one line, or as one line per pressure if something else is imposed.
std::vector<CurvePart> parts_of(const CurveComparison& comparison, std::size_t column) {
  const std::vector<double>& pressures = comparison.curve.values[0];
  const std::string name = io::shown_column(comparison.curve.columns[column]).quantity;
  if (meshes::abscissa_count(comparison.load_case().kind) == 1) return {{name, column, 0, pressures.size()}};
  std::vector<CurvePart> parts;
  for (std::size_t begin = 0, end = 0; begin < pressures.size(); begin = end) {
    while (end < pressures.size() && pressures[end] == pressures[begin]) ++end;
    parts.push_back({name + ", " + io::kilopascals(pressures[begin]), column, begin, end});
  }
  return parts;
}

void add_part(io::ChartPanel& panel, const CurveComparison& comparison, const CurvePart& part) {
  const std::size_t abscissa = meshes::abscissa_count(comparison.load_case().kind) - 1;
  const double x_factor = io::shown_column(comparison.curve.columns[abscissa]).factor;
  const double y_factor = io::shown_column(comparison.curve.columns[part.column]).factor;
  const io::Colour colour = io::chart_colour(panel.series.size() / 2);
  io::ChartSeries elements{.name = part.name, .marks = io::Marks::points, .colour = colour};
  io::ChartSeries surrogate{.marks = io::Marks::line, .colour = colour};
  const std::vector<double>& responses = comparison.response.values[part.column];
  for (std::size_t row = part.begin; row < part.end; ++row) {
    const double x = x_factor * comparison.curve.values[abscissa][row];
    elements.x.push_back(x);
    elements.y.push_back(y_factor * comparison.curve.values[part.column][row]);
    if (!comparison.response_rows[row]) continue;
    surrogate.x.push_back(x);
    surrogate.y.push_back(y_factor * responses[*comparison.response_rows[row]]);
  }
  if (surrogate.x.size() == 1) surrogate.marks = io::Marks::line_and_points;
  panel.series.push_back(elements);
  panel.series.push_back(surrogate);
}

/// Gives curves that cannot be told apart one name, such as those of two feet of a body that is its own mirror image.
/// @pre every curve has two series, first finite elements and then the surrogate
void join_what_coincides(io::ChartPanel& panel) {
  double lowest = std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::lowest();
  for (const io::ChartSeries& series : panel.series) {
    for (const double y : series.y) {
      lowest = std::min(lowest, y);
      highest = std::max(highest, y);
    }
  }
  const auto coincide = [&](const io::ChartSeries& a, const io::ChartSeries& b) {
    return a.x == b.x && io::look_alike(a.y, b.y, highest - lowest);
  };
  std::vector<io::ChartSeries> kept;
  for (std::size_t n = 0; n + 1 < panel.series.size(); n += 2) {
    bool is_hidden = false;
    for (std::size_t k = 0; k + 1 < kept.size() && !is_hidden; k += 2) {
      is_hidden = coincide(kept[k], panel.series[n]) && coincide(kept[k + 1], panel.series[n + 1]);
      if (is_hidden) kept[k].name += ", " + panel.series[n].name;
    }
    if (!is_hidden) kept.insert(kept.end(), {panel.series[n], panel.series[n + 1]});
  }
  panel.series = std::move(kept);
}

io::PictureOutcome write(const std::filesystem::path& file, const io::Chart& chart) {
  return io::write_chart(file, chart,
                         {.width_px = panel_width_px * static_cast<int>(chart.panels.size()), .height_px = panel_height_px});
}

}  // namespace

io::Chart errors_chart(const std::vector<CurveComparison>& comparisons, double aim) {
  const Shown is_shown(comparisons);
  io::Chart chart{.title = std::string("surrogate against finite elements, ") +
                           (is_shown.is_all_outside() ? "all outside the range of validity: nothing was compared inside"
                                                      : "inside the range of validity"),
                  .panels = {}};
  chart.panels.push_back(spread_panel(comparisons, is_shown, aim));
  // A marker must lie inside the axis.
  double largest = 110.0 * aim;
  for (const io::ChartSeries& series : chart.panels.front().series) largest = std::max(largest, 1.02 * series.x.back());
  chart.panels.front().x.highest = largest;
  for (const ObservableKind kind : {ObservableKind::displacement, ObservableKind::volume})
    chart.panels.push_back(pressure_panel(comparisons, is_shown, kind, aim));
  return chart;
}

io::PictureOutcome draw_errors(const std::filesystem::path& file, const std::vector<CurveComparison>& comparisons, double aim) {
  return write(file, errors_chart(comparisons, aim));
}

io::Chart curve_chart(const CurveComparison& comparison) {
  io::Chart chart{.title = comparison.load_case().name + ": finite elements (points), surrogate (lines)", .panels = {}};
  const std::vector<std::string>& columns = comparison.curve.columns;
  const std::size_t first = meshes::abscissa_count(comparison.load_case().kind);
  std::vector<std::vector<std::string>> shared;  // columns of each panel
  for (std::size_t column = first; column < columns.size(); ++column) {
    const std::string unit = io::shown_column(columns[column]).unit;
    auto known = std::ranges::find_if(shared, [&](const auto& of) { return io::shown_column(of.front()).unit == unit; });
    if (known == shared.end()) {
      known = shared.insert(known, std::vector<std::string>());
      chart.panels.push_back({.x = {.title = io::shown_column(columns[first - 1]).title()}});
    }
    known->push_back(columns[column]);
    io::ChartPanel& panel = chart.panels[static_cast<std::size_t>(known - shared.begin())];
    panel.y.title = meshes::response_axis_title(*known);
    for (const CurvePart& part : parts_of(comparison, column)) add_part(panel, comparison, part);
  }
  for (io::ChartPanel& panel : chart.panels) join_what_coincides(panel);
  return chart;
}

io::PictureOutcome draw_curve(const std::filesystem::path& file, const CurveComparison& comparison) {
  return write(file, curve_chart(comparison));
}

}  // namespace menger::voxel
