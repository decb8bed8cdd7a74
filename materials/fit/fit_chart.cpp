#include "materials/fit/fit_chart.h"

#include <algorithm>
#include <limits>
#include <string>

#include "io/picture/chart.h"
#include "io/shown/shown_quantity.h"

namespace menger::materials {
namespace {

constexpr double beyond = 0.25;  // of the highest fitted strain
constexpr int parts = 200;

/// The range of stretches that the chart shows.
struct Span {
  double low = 1.0;
  double fitted = 1.0;  ///< the largest fitted stretch
  double high = 1.0;
};

Span span_of(const FitReport& report, const TensileTest& test) {
  Span span;
  const FittedRows rows = fitted_rows(test, report.range);
  span.low = std::min(span.low, 1.0 + rows.lowest_strain);
  span.fitted = std::max(span.fitted, 1.0 + rows.highest_strain);
  span.high = span.fitted + beyond * (span.fitted - 1.0);
  return span;
}

io::ChartSeries measured(const TensileTest& test, const Span& span) {
  io::ChartSeries series{.name = "measured", .marks = io::Marks::points, .colour = io::chart_ink};
  for (std::size_t i = 0; i < test.strain.size(); ++i) {
    const double stretch = 1.0 + test.strain[i];
    if (stretch < span.low || stretch > span.high) continue;
    series.x.push_back(stretch);
    series.y.push_back(1e-3 * test.stress_Pa[i]);
  }
  return series;
}

io::ChartSeries curve_of(const LawFit& fit, std::size_t place, const Span& span) {
  const std::string name = std::to_string(place + 1) + "  " + fit.name + ", " + io::kilopascals(fit.rmse_Pa);
  io::ChartSeries series{.name = name, .dashed = !fit.stable, .colour = io::chart_colour(place)};
  for (int i = 0; i <= parts; ++i) {
    const double stretch = span.low + (span.high - span.low) * i / parts;
    const NominalStress stress = nominal_stress(fit.law, LoadingMode::uniaxial, stretch);
    series.x.push_back(stretch);
    series.y.push_back(stress.status == LawStatus::valid ? 1e-3 * stress.stress_Pa : std::numeric_limits<double>::quiet_NaN());
  }
  return series;
}

/// Whether a law leaves the range of the axis.
bool goes_beyond(const io::ChartPanel& panel) {
  const auto is_beyond = [&](double stress) { return stress > *panel.y.highest || stress < *panel.y.lowest; };
  return std::ranges::any_of(panel.series,
                             [&](const io::ChartSeries& series) { return std::ranges::any_of(series.y, is_beyond); });
}

}  // namespace

io::PictureOutcome write_fit_chart(const std::filesystem::path& file, const FitReport& report, const TensileTest& test) {
  const Span span = span_of(report, test);
  const io::ChartSeries points = measured(test, span);
  // The chart leaves room for laws above the measurement, but not for those far beyond it.
  const auto [lowest, highest] = std::minmax_element(points.y.begin(), points.y.end());
  const double room = 0.3 * std::max(*highest, -*lowest);
  io::ChartPanel stable{.title = "stable laws with their RMS error: usable laws first, each group by AIC",
                        .x = {.title = "stretch", .lowest = span.low, .highest = span.high},
                        .y = {.title = "nominal stress (kPa)",
                              .lowest = *lowest < 0.0 ? *lowest - room : 0.0,
                              .highest = *highest > 0.0 ? *highest + room : 0.0},
                        .series = {},
                        .markers = {{io::ChartMarker::Direction::vertical, span.fitted, "largest fitted stretch"}}};
  io::ChartPanel unstable = stable;
  unstable.title = "laws that are not stable, with their RMS error: by AIC";
  for (std::size_t place = 0; place < report.ranking.size(); ++place) {
    const LawFit& fit = report.ranking[place];
    (fit.stable ? stable : unstable).series.push_back(curve_of(fit, place, span));
  }
  for (io::ChartPanel* panel : {&stable, &unstable})
    if (goes_beyond(*panel)) panel->y.title += "; higher and lower ends are cut off";
  const bool any_stable = !stable.series.empty();
  const bool any_unstable = !unstable.series.empty();
  stable.series.push_back(points);
  unstable.series.push_back(points);
  io::Chart chart{.title = report.material.empty() ? report.file.stem().string() : report.material};
  if (any_stable || !any_unstable) chart.panels.push_back(stable);
  if (any_unstable) chart.panels.push_back(unstable);
  return io::write_chart(file, chart, {.width_px = 1000 * static_cast<int>(chart.panels.size()), .height_px = 900});
}

}  // namespace menger::materials
