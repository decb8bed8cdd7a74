#pragma once

#include <vtkContextScene.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

#include "io/picture/chart.h"

namespace menger::io {

/// The place of a panel, in pixels of the window from its lower left corner.
struct PanelPlace {
  double left = 0.0;
  double bottom = 0.0;
  double width = 0.0;  ///< including titles and labels
  double height = 0.0;
  int font_size = 0;
};

/// Adds a panel to a window: its curves to the scene and its texts to the renderer of the scene.
void add_panel(vtkContextScene& scene, vtkRenderer& renderer, const ChartPanel& panel, const PanelPlace& place);

/// Adds a line of text.
/// @param x, y position of the anchor of the text, in pixels
/// @param across, up which point of the text is the anchor: -1 left or bottom, 0 middle, 1 right or top
/// @return the properties of the text, which the caller may change
vtkTextProperty& add_text(vtkRenderer& renderer, const std::string& text, double x, double y, int across, int up, int font_size);

}  // namespace menger::io
