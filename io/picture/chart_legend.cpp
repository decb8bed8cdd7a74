#include "io/picture/chart_legend.h"

#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace menger::io {
namespace {

/// A width and a height, or a point, as fractions of the size of the panel.
using Fractions = std::array<double, 2>;

struct Corner {
  bool right = false;
  bool top = false;
};

/// The names in the legend.
std::vector<std::string> names_in(const ChartPanel& panel) {
  std::vector<std::string> names;
  for (const ChartSeries& series : panel.series)
    if (!series.name.empty()) names.push_back(series.name);
  for (const ChartMarker& marker : panel.markers)
    if (!marker.label.empty()) names.push_back(marker.label);
  return names;
}

/// Estimates the size of the legend. VTK computes it only while drawing.
Fractions legend_size(const std::vector<std::string>& names, const std::array<double, 2>& size_px, int font_size) {
  std::size_t letters = 0;
  for (const std::string& name : names) letters = std::max(letters, name.size());
  return {(0.56 * static_cast<double>(letters) + 5.0) * font_size / size_px[0],
          (1.35 * static_cast<double>(names.size()) + 1.5) * font_size / size_px[1]};
}

/// Returns points along the curves as fractions of the panel. They are so close together that every curve that crosses a legend
/// is noticed.
std::vector<Fractions> points_along(const ChartPanel& panel, const ChartScale& x, const ChartScale& y) {
  constexpr int parts = 16;
  std::vector<Fractions> points;
  for (const ChartSeries& series : panel.series) {
    std::optional<Fractions> before;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) {
        before.reset();
        continue;
      }
      const Fractions point{x.fraction(series.x[i]), y.fraction(series.y[i])};
      const bool joined = before && series.marks != Marks::points;
      for (int part = joined ? 1 : parts; part <= parts; ++part) {
        const double way = static_cast<double>(part) / parts;
        const Fractions& from = joined ? *before : point;
        points.push_back({from[0] + way * (point[0] - from[0]), from[1] + way * (point[1] - from[1])});
      }
      before = point;
    }
  }
  return points;
}

}  // namespace

PanelChart* PanelChart::New() { VTK_STANDARD_NEW_BODY(PanelChart); }

void PanelChart::SetLegendPosition(const vtkRectf& rect) {
  vtkChartXY::SetLegendPosition(rect);
  vtkChartLegend& legend = *GetLegend();
  const auto inset = 0.5F * static_cast<float>(legend.GetLabelSize());
  vtkVector2f point = legend.GetPointVector();
  point[0] += legend.GetHorizontalAlignment() == vtkChartLegend::LEFT ? inset : -inset;
  point[1] += legend.GetVerticalAlignment() == vtkChartLegend::BOTTOM ? inset : -inset;
  legend.SetPoint(point);
}

void place_legend(PanelChart& chart, const ChartPanel& panel, const ChartScale& x, const ChartScale& y,
                  const std::array<double, 2>& size_px, int font_size) {
  const std::vector<std::string> names = names_in(panel);
  if (names.empty()) return;
  const Fractions size = legend_size(names, size_px, font_size);
  const std::vector<Fractions> points = points_along(panel, x, y);
  Corner best{};
  auto fewest = std::numeric_limits<std::ptrdiff_t>::max();
  for (const Corner corner : {Corner{false, true}, {true, false}, {true, true}, {false, false}}) {
    const auto hidden = std::count_if(points.begin(), points.end(), [&](const Fractions& point) {
      const double across = corner.right ? 1.0 - point[0] : point[0];
      const double down = corner.top ? 1.0 - point[1] : point[1];
      return across < size[0] && down < size[1];
    });
    if (hidden >= fewest) continue;
    fewest = hidden;
    best = corner;
  }
  chart.SetShowLegend(true);
  vtkChartLegend& legend = *chart.GetLegend();
  legend.SetInline(true);
  legend.SetHorizontalAlignment(best.right ? vtkChartLegend::RIGHT : vtkChartLegend::LEFT);
  legend.SetVerticalAlignment(best.top ? vtkChartLegend::TOP : vtkChartLegend::BOTTOM);
  legend.SetLabelSize(font_size);
  legend.SetSymbolWidth(2 * font_size);
  legend.SetPadding(font_size / 2);
  legend.GetPen()->SetColor(215, 215, 215);
  legend.GetPen()->SetWidth(supersampling);
  legend.GetBrush()->SetColor(255, 255, 255, 225);
}

}  // namespace menger::io
