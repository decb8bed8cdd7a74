#pragma once

#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "io/picture/picture.h"

namespace menger::fem {

/// Parts of the picture of a body. Lengths of the scene are in metres; sizes in the picture follow its style.

/// Adds the light of the scene.
void add_light(vtkRenderer& renderer);

/// Adds the surface of a grid, coloured by its active scalars from 0 to `highest`.
void add_body(vtkRenderer& renderer, vtkUnstructuredGrid& grid, double highest);

/// Adds the sharp edges of a grid's surface as lines that are visible through the body.
void add_outline(vtkRenderer& renderer, vtkUnstructuredGrid& grid);

/// Adds the sharp edges of a grid's outer surface, without those of closed chambers, as thin grey lines where its active scalars
/// are less than `below`: for what a cut takes away.
void add_faint_outline(vtkRenderer& renderer, vtkUnstructuredGrid& grid, double below);

/// Points the camera at grids, from the side of small y, in parallel projection, so that they fill the picture.
/// @return pixels of the window (not of the picture) per metre
double aim(vtkRenderer& renderer, const std::vector<vtkUnstructuredGrid*>& grids, const io::PictureStyle& style);

/// Adds a scale bar of a round length, with its length written at it.
void add_scale_bar(vtkRenderer& renderer, double pixels_per_m, const io::PictureStyle& style);

/// Adds a colour bar from 0 to `highest`.
void add_colour_bar(vtkRenderer& renderer, const std::string& title, double highest, const io::PictureStyle& style);

/// Adds a caption at the top of the picture.
void add_caption(vtkRenderer& renderer, const std::string& caption, const io::PictureStyle& style);

}  // namespace menger::fem
