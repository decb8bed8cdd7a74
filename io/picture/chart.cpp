#include "io/picture/chart.h"

#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "io/picture/chart_panel.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"

namespace menger::io {
namespace {

/// The first eight colours follow the palette of Okabe and Ito for colour-blind readers, without its yellow, which is too bright
/// for lines on white.
constexpr std::array<Colour, 12> colours{{{0, 114, 178},
                                          {213, 94, 0},
                                          {0, 158, 115},
                                          {204, 121, 167},
                                          {230, 159, 0},
                                          {86, 180, 233},
                                          {130, 80, 40},
                                          {120, 120, 120},
                                          {70, 50, 150},
                                          {150, 150, 40},
                                          {150, 30, 80},
                                          {0, 90, 60}}};

void require_positive(const std::vector<double>& values, const std::string& where) {
  for (const double value : values) {
    if (value <= 0.0) throw InputError(where + " = " + number_text(value) + ": must be > 0 on a logarithmic axis");
  }
}

void check(const std::filesystem::path& file, const Chart& chart) {
  assert(!chart.panels.empty());
  for (const ChartPanel& panel : chart.panels) {
    assert(!panel.equal_scale || !(panel.x.logarithmic || panel.y.logarithmic));
    for (const ChartSeries& series : panel.series) {
      assert(series.x.size() == series.y.size());
      const std::string where = file.string() + ": series \"" + series.name + "\": ";
      if (panel.x.logarithmic) require_positive(series.x, where + "x");
      if (panel.y.logarithmic) require_positive(series.y, where + "y");
    }
    for (const ChartMarker& marker : panel.markers) {
      const ChartAxis& axis = marker.direction == ChartMarker::Direction::vertical ? panel.x : panel.y;
      if (axis.logarithmic) require_positive({marker.at}, file.string() + ": marker \"" + marker.label + "\"");
    }
  }
}

void fill_window(vtkRenderWindow& window, const Chart& chart, const PictureStyle& style) {
  vtkNew<vtkContextActor> actor;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);

  const auto panels = static_cast<double>(chart.panels.size());
  const double width = supersampling * style.width_px;
  const double height = supersampling * style.height_px;
  const int font_size = static_cast<int>(std::min(height / 44.0, width / (50.0 * std::sqrt(panels))));
  const double title = chart.title.empty() ? 0.0 : 2.4 * font_size;
  if (title > 0.0) {
    add_text(*renderer, chart.title, 0.5 * width, height - 0.5 * title - 0.3 * font_size, 0, 0,
             static_cast<int>(1.25 * font_size));
  }
  for (std::size_t i = 0; i < chart.panels.size(); ++i) {
    const PanelPlace place{.left = static_cast<double>(i) * width / panels,
                           .bottom = 0.0,
                           .width = width / panels,
                           .height = height - title,
                           .font_size = font_size};
    add_panel(*actor->GetScene(), *renderer, chart.panels[i], place);
  }
  window.AddRenderer(renderer);
}

}  // namespace

Colour chart_colour(std::size_t series) { return colours.at(series % colours.size()); }

bool look_alike(const std::vector<double>& a, const std::vector<double>& b, double span) {
  constexpr double least_seen = 2e-3;  // of an axis of some hundred pixels
  if (a.size() != b.size()) return false;
  for (std::size_t n = 0; n < a.size(); ++n) {
    const bool is_gap = !std::isfinite(a[n]) || !std::isfinite(b[n]);
    if (is_gap ? std::isfinite(a[n]) != std::isfinite(b[n]) : std::abs(a[n] - b[n]) > least_seen * span) return false;
  }
  return true;
}

PictureOutcome write_chart(const std::filesystem::path& file, const Chart& chart, const PictureStyle& style) {
  check(file, chart);
  return write_picture(file, style, [&](vtkRenderWindow& window) { fill_window(window, chart, style); });
}

}  // namespace menger::io
