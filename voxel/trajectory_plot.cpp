#include <vtkAxis.h>
#include <vtkChartMatrix.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "materials/observables.h"
#include "voxel/picture.h"
#include "voxel/preview.h"

namespace menger::voxel {
namespace {

/// Axes cover at least this many body lengths, so that a body that stays where it is does not fill the plot with its tremor.
constexpr double least_span = 0.02;

/// Round numbers (1, 2 or 5 times a power of ten apart) that divide an axis into about six parts.
void set_ticks(vtkAxis& axis, double low, double high) {
  const double rough = std::max(high - low, 1e-12) / 6.0;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = decade * (rough > 5.0 * decade ? 10.0 : rough > 2.0 * decade ? 5.0 : rough > decade ? 2.0 : 1.0);
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    const double position = i == 0.0 ? 0.0 : i * step;  // never -0
    positions->InsertNextValue(position);
    std::array<char, 32> label{};
    std::snprintf(label.data(), label.size(), "%.4g", position);
    labels->InsertNextValue(label.data());
  }
  axis.SetBehavior(vtkAxis::FIXED);
  axis.SetRange(low, high);
  axis.SetCustomTickPositions(positions, labels);
}

void format_axis(vtkAxis& axis, const char* title, int font_size) {
  axis.SetTitle(title);
  axis.GetTitleProperties()->SetFontSize(font_size);
  axis.GetTitleProperties()->BoldOff();
  axis.GetLabelProperties()->SetFontSize(font_size);
  axis.GetPen()->SetWidth(supersampling);
  axis.GetGridPen()->SetColorF(0.9, 0.9, 0.9);
  axis.GetGridPen()->SetWidth(supersampling);
}

void add_line(vtkChartXY& chart, const std::vector<double>& x, const std::vector<double>& y, const char* x_title,
              const char* y_title, int font_size) {
  vtkNew<vtkTable> table;
  for (const auto& [name, values] : {std::pair{x_title, &x}, std::pair{y_title, &y}}) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    for (const double value : *values) column->InsertNextValue(value);
    table->AddColumn(column);
  }
  vtkPlot* line = chart.AddPlot(vtkChart::LINE);
  line->SetInputData(table, 0, 1);
  line->SetColor(24, 128, 148, 255);
  line->SetWidth(2.5F * supersampling);
  format_axis(*chart.GetAxis(vtkAxis::BOTTOM), x_title, font_size);
  format_axis(*chart.GetAxis(vtkAxis::LEFT), y_title, font_size);
}

using Interval = std::pair<double, double>;

Interval interval_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

void set_time_axes(vtkChartXY& chart, const std::vector<double>& time, const std::vector<double>& distance) {
  const double highest = std::max(1.05 * interval_of(distance).second, least_span);
  set_ticks(*chart.GetAxis(vtkAxis::BOTTOM), time.front(), std::max(time.back(), time.front() + 1e-6));
  set_ticks(*chart.GetAxis(vtkAxis::LEFT), 0.0, highest);
}

/// Both axes to the same scale, with the path in the middle. @param aspect width by height of the chart
void set_path_axes(vtkChartXY& chart, const std::vector<double>& x, const std::vector<double>& y, double aspect) {
  const auto [x_low, x_high] = interval_of(x);
  const auto [y_low, y_high] = interval_of(y);
  const double width = 1.15 * std::max({x_high - x_low, aspect * (y_high - y_low), least_span});
  const double height = width / aspect;
  set_ticks(*chart.GetAxis(vtkAxis::BOTTOM), 0.5 * (x_low + x_high - width), 0.5 * (x_low + x_high + width));
  set_ticks(*chart.GetAxis(vtkAxis::LEFT), 0.5 * (y_low + y_high - height), 0.5 * (y_low + y_high + height));
}

}  // namespace

PictureOutcome plot_trajectory(const std::filesystem::path& file, const Trajectory& trajectory, double body_length_m,
                               const PictureStyle& style) {
  if (trajectory.size() < 2) return {.missing = "a trajectory of at least two records"};
  std::vector<double> time, distance, x, y;
  for (const TrajectoryPoint& point : trajectory) {
    const auto displacement = displacement_m(trajectory, point);
    time.push_back(point.time_s);
    distance.push_back(materials::horizontal_displacement(displacement) / body_length_m);
    x.push_back(displacement[0] / body_length_m);
    y.push_back(displacement[1] / body_length_m);
  }

  return write_picture(file, style, [&](vtkRenderWindow& window) {
    const int font_size = supersampling * style.height_px / 50;
    const float border = 4.5F * static_cast<float>(font_size);
    const float gutter = 1.3F * border;
    vtkNew<vtkChartMatrix> charts;
    charts->SetSize(vtkVector2i(2, 1));
    charts->SetGutter(vtkVector2f(gutter, 0.0F));
    charts->SetBorders(static_cast<int>(1.2F * border), static_cast<int>(border), static_cast<int>(0.4F * border),
                       static_cast<int>(0.4F * border));
    charts->Allocate();
    auto& over_time = *vtkChartXY::SafeDownCast(charts->GetChart(vtkVector2i(0, 0)));
    add_line(over_time, time, distance, "time (s)", "horizontal displacement (body lengths)", font_size);
    set_time_axes(over_time, time, distance);
    auto& from_above = *vtkChartXY::SafeDownCast(charts->GetChart(vtkVector2i(1, 0)));
    add_line(from_above, x, y, "path from above: x (body lengths)", "y (body lengths)", font_size);
    const double chart_width = 0.5 * (supersampling * style.width_px - 1.6 * border - gutter);
    const double chart_height = supersampling * style.height_px - 1.4 * border;
    set_path_axes(from_above, x, y, chart_width / chart_height);

    vtkNew<vtkContextActor> actor;
    actor->GetScene()->AddItem(charts);
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1.0, 1.0, 1.0);
    renderer->AddActor(actor);
    actor->GetScene()->SetRenderer(renderer);
    window.AddRenderer(renderer);
  });
}

}  // namespace menger::voxel
