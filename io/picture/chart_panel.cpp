#include "io/picture/chart_panel.h"

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "io/picture/chart_legend.h"
#include "io/picture/chart_scale.h"

namespace menger::io {
namespace {

constexpr float line_width = 2.5F * supersampling;
constexpr float marker_width = 1.5F * supersampling;
constexpr float dot_width = 8.0F * supersampling;
constexpr double letter_width = 0.56;  // of the font size, on average
constexpr Colour marker_colour{110, 110, 110};

using Scales = std::pair<ChartScale, ChartScale>;

/// The rectangle between the axes, in pixels of the window.
struct Inside {
  double left, bottom, width, height;
};

/// Returns all values along an axis, including those of markers.
std::vector<double> values_along(const ChartPanel& panel, ChartMarker::Direction direction) {
  std::vector<double> values;
  for (const ChartSeries& series : panel.series) {
    const std::vector<double>& part = direction == ChartMarker::Direction::vertical ? series.x : series.y;
    values.insert(values.end(), part.begin(), part.end());
  }
  for (const ChartMarker& marker : panel.markers) {
    if (marker.direction == direction) values.push_back(marker.at);
  }
  return values;
}

void set_axis(vtkAxis& axis, const ChartScale& scale, int font_size) {
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const ChartTick& tick : scale.ticks()) {
    positions->InsertNextValue(tick.at);
    labels->InsertNextValue(tick.label);
  }
  axis.SetBehavior(vtkAxis::FIXED);
  axis.SetRange(scale.low, scale.high);
  axis.SetCustomTickPositions(positions, labels);
  axis.SetTitle("");  // the title is written with the other texts: VTK would let it touch long labels
  axis.SetTickLength(0.3F * static_cast<float>(font_size));
  axis.SetLabelOffset(0.6F * static_cast<float>(font_size));
  axis.GetLabelProperties()->SetFontSize(font_size);
  axis.GetPen()->SetWidth(supersampling);
  axis.GetPen()->SetColor(90, 90, 90);
  axis.GetGridPen()->SetColor(232, 232, 232);
  axis.GetGridPen()->SetWidth(supersampling);
}

std::size_t drawn_points(const ChartSeries& series) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < series.x.size(); ++i) count += std::isfinite(series.x[i]) && std::isfinite(series.y[i]) ? 1U : 0U;
  return count;
}

/// A line through one point would be neither seen nor accepted by VTK: the point is drawn.
Marks shown_marks(const ChartSeries& series) { return drawn_points(series) == 1 ? Marks::points : series.marks; }

vtkPlot* add_curve(vtkChartXY& chart, const ChartSeries& series, const Scales& scales, const Colour& colour) {
  vtkNew<vtkTable> table;
  for (const auto& [name, values, scale] :
       {std::tuple{"x", &series.x, &scales.first}, std::tuple{"y", &series.y, &scales.second}}) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    for (const double value : *values) column->InsertNextValue(std::isfinite(value) ? scale->coordinate(value) : value);
    table->AddColumn(column);
  }
  const Marks marks = shown_marks(series);
  const bool points_only = marks == Marks::points;
  auto& plot = *vtkPlotPoints::SafeDownCast(chart.AddPlot(points_only ? vtkChart::POINTS : vtkChart::LINE));
  plot.SetInputData(table, 0, 1);
  plot.SetLabel(" " + series.name);  // the legend puts no space between line and name
  plot.SetLegendVisibility(!series.name.empty());
  plot.SetColor(colour[0], colour[1], colour[2], 255);
  plot.SetWidth(line_width);
  plot.GetPen()->SetLineType(series.dashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
  plot.SetMarkerStyle(marks == Marks::line ? vtkPlotPoints::NONE : vtkPlotPoints::CIRCLE);
  plot.SetMarkerSize(dot_width);
  return &plot;
}

vtkPlot* add_marker(vtkChartXY& chart, const ChartMarker& marker, const Scales& scales) {
  const auto& [x, y] = scales;
  const bool across = marker.direction == ChartMarker::Direction::horizontal;
  const double at = (across ? y : x).coordinate(marker.at);
  vtkNew<vtkTable> table;
  for (const auto& [name, from, to] :
       {std::tuple{"x", across ? x.low : at, across ? x.high : at}, std::tuple{"y", across ? at : y.low, across ? at : y.high}}) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    column->InsertNextValue(from);
    column->InsertNextValue(to);
    table->AddColumn(column);
  }
  vtkPlot& line = *chart.AddPlot(vtkChart::LINE);
  line.SetInputData(table, 0, 1);
  line.SetLabel(" " + marker.label);
  line.SetLegendVisibility(!marker.label.empty());
  line.SetColor(marker_colour[0], marker_colour[1], marker_colour[2], 255);
  line.SetWidth(marker_width);
  line.GetPen()->SetLineType(vtkPen::DASH_LINE);
  return &line;
}

double widest_label(const ChartScale& scale) {
  std::size_t letters = 0;
  for (const ChartTick& tick : scale.ticks()) letters = std::max(letters, tick.label.size());
  return letter_width * static_cast<double>(letters);
}

}  // namespace

vtkTextProperty& add_text(vtkRenderer& renderer, const std::string& text, double x, double y, int across, int up, int font_size) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(x, y);
  vtkTextProperty& property = *actor->GetTextProperty();
  property.SetFontSize(font_size);
  property.SetColor(0.15, 0.15, 0.15);
  property.SetJustification(across < 0 ? VTK_TEXT_LEFT : across > 0 ? VTK_TEXT_RIGHT : VTK_TEXT_CENTERED);
  property.SetVerticalJustification(up < 0 ? VTK_TEXT_BOTTOM : up > 0 ? VTK_TEXT_TOP : VTK_TEXT_CENTERED);
  renderer.AddActor2D(actor);
  return property;
}

void add_panel(vtkContextScene& scene, vtkRenderer& renderer, const ChartPanel& panel, const PanelPlace& place) {
  const int font = place.font_size;
  Scales scales{scale_of(panel.x, values_along(panel, ChartMarker::Direction::vertical)),
                scale_of(panel.y, values_along(panel, ChartMarker::Direction::horizontal))};
  const double title = panel.title.empty() ? 0.0 : 2.0 * font;
  Inside inside{.left = 0.0, .bottom = place.bottom + 4.2 * font, .width = 0.0, .height = place.height - 5.2 * font - title};
  const auto place_between = [&](double labels) {
    inside.left = place.left + (3.2 + labels) * font;
    inside.width = place.width - (4.6 + labels) * font;
  };
  place_between(widest_label(scales.second));
  if (panel.equal_scale) {
    make_equal(scales.first, scales.second, inside.width / inside.height);
    place_between(widest_label(scales.second));  // other ticks may have labels of another width
    make_equal(scales.first, scales.second, inside.width / inside.height);
  }

  vtkNew<PanelChart> chart;
  chart->SetAutoSize(false);
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  chart->SetSize(vtkRectf(static_cast<float>(inside.left), static_cast<float>(inside.bottom), static_cast<float>(inside.width),
                          static_cast<float>(inside.height)));
  set_axis(*chart->GetAxis(vtkAxis::BOTTOM), scales.first, font);
  set_axis(*chart->GetAxis(vtkAxis::LEFT), scales.second, font);
  // Each below those before it.
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    if (drawn_points(panel.series[i]) == 0) continue;  // VTK reports an error for each
    chart->LowerPlot(add_curve(*chart, panel.series[i], scales, panel.series[i].colour.value_or(chart_colour(i))));
  }
  for (const ChartMarker& marker : panel.markers) chart->LowerPlot(add_marker(*chart, marker, scales));
  place_legend(*chart, panel, scales.first, scales.second, {inside.width, inside.height}, font);
  scene.AddItem(chart);

  add_text(renderer, panel.x.title, inside.left + 0.5 * inside.width, place.bottom + 0.9 * font, 0, -1, font);
  add_text(renderer, panel.y.title, place.left + 1.9 * font, inside.bottom + 0.5 * inside.height, 0, -1, font)
      .SetOrientation(90.0);
  if (title > 0.0) {
    add_text(renderer, panel.title, inside.left + 0.5 * inside.width, inside.bottom + inside.height + 0.7 * font, 0, -1,
             static_cast<int>(1.1 * font));
  }
}

}  // namespace menger::io
