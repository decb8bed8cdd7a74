#pragma once

#include <vtkChartXY.h>

#include <array>

#include "io/picture/chart_scale.h"

namespace menger::io {

/// A chart whose legend keeps a distance from the axes, which the library lets it cover.
class PanelChart : public vtkChartXY {
 public:
  static PanelChart* New();  // NOLINT(readability-identifier-naming): called by the library

  void SetLegendPosition(const vtkRectf& rect) override;  // NOLINT(readability-identifier-naming): of the library
};

/// Shows the legend of a panel if a series has a name, in the corner with the fewest points of curves.
/// @param size_px width and height between the axes
void place_legend(PanelChart& chart, const ChartPanel& panel, const ChartScale& x, const ChartScale& y,
                  const std::array<double, 2>& size_px, int font_size);

}  // namespace menger::io
