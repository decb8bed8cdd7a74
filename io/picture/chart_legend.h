#pragma once

#include <vtkChartXY.h>

#include <array>

#include "io/picture/chart_scale.h"

namespace menger::io {

/// A chart that keeps its legend at a distance from the axes. In VTK itself the legend may cover the axes.
class PanelChart : public vtkChartXY {
 public:
  static PanelChart* New();  // NOLINT(readability-identifier-naming): called by the library

  void SetLegendPosition(const vtkRectf& rect) override;  // NOLINT(readability-identifier-naming): of the library
};

/// Shows the legend of a panel if one of its series has a name. The legend stands in the corner with the fewest points of curves.
/// @param size_px width and height of the area between the axes
void place_legend(PanelChart& chart, const ChartPanel& panel, const ChartScale& x, const ChartScale& y,
                  const std::array<double, 2>& size_px, int font_size);

}  // namespace menger::io
