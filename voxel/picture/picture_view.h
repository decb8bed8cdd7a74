#pragma once

#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <array>
#include <limits>

#include "voxel/engine/frame.h"

namespace menger::voxel {

using Vector = std::array<double, 3>;

/// Unit vectors of the view: from the scene to the eye, to the right in the picture (horizontal), and upwards in the picture.
struct View {
  Vector eye, right, up;

  /// Coordinates of a point along right, up and eye.
  [[nodiscard]] Vector coordinates(const Vector& point) const;

  /// The vector in space that corresponds to a displacement to the right and upwards in the picture.
  [[nodiscard]] Vector across(double to_right, double upward) const;
};

/// A view from above at an angle, with parallel projection.
View isometric_view();

/// The smallest box around points. Its axes are those of the points that are added.
struct Extent {
  Vector low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  Vector high{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest(),
              std::numeric_limits<double>::lowest()};

  void add(const Vector& point);
  void unite(const Extent& other);
  [[nodiscard]] double size(std::size_t axis) const { return high[axis] - low[axis]; }
  [[nodiscard]] double centre(std::size_t axis) const { return 0.5 * (low[axis] + high[axis]); }
};

/// The smallest box along the world's axes that contains all voxels of a frame, or all points of a surface.
Extent world_extent(const Frame& frame);
Extent world_extent(vtkPolyData& surface);

/// The smallest box along the axes of a view: to the right, up, and towards the camera.
Extent view_extent(const Frame& frame, const View& view);
Extent view_extent(vtkPolyData& surface, const View& view);

/// Points the camera along the view, so that the extent (in the axes of the view) fills the picture.
/// @param aspect width / height of the picture @param margin fraction of the picture that stays free at the border
void aim(vtkRenderer& renderer, const View& view, const Extent& extent, double aspect, double margin);

}  // namespace menger::voxel
