#include "voxel/picture/picture_view.h"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

#include "voxel/picture/cube.h"

namespace menger::voxel {
namespace {

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Coordinates>
Extent extent_of(const Frame& frame, const Coordinates& coordinates) {
  Extent extent;
  for (std::size_t voxel = 0; voxel < frame.position_m.size(); ++voxel) {
    for (const Vector& corner : cube_corners_m(frame, voxel)) extent.add(coordinates(corner));
  }
  return extent;
}

template <class Coordinates>
Extent extent_of(vtkPolyData& surface, const Coordinates& coordinates) {
  Extent extent;
  for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
    Vector point{};
    surface.GetPoint(i, point.data());
    extent.add(coordinates(point));
  }
  return extent;
}

}  // namespace

Vector View::coordinates(const Vector& point) const { return {dot(right, point), dot(up, point), dot(eye, point)}; }

Vector View::across(double to_right, double upward) const {
  Vector vector{};
  for (std::size_t axis = 0; axis < 3; ++axis) vector.at(axis) = to_right * right.at(axis) + upward * up.at(axis);
  return vector;
}

View isometric_view() {
  constexpr double azimuth = -0.95;   // radians from the x axis: not symmetric, so that faces and edges do not line up
  constexpr double elevation = 0.48;  // radians above the ground
  const Vector eye{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  const Vector right{-std::sin(azimuth), std::cos(azimuth), 0.0};
  return {.eye = eye, .right = right, .up = cross(eye, right)};
}

void Extent::add(const Vector& point) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], point[axis]);
    high[axis] = std::max(high[axis], point[axis]);
  }
}

void Extent::unite(const Extent& other) {
  add(other.low);
  add(other.high);
}

Extent world_extent(const Frame& frame) {
  return extent_of(frame, [](const Vector& point) { return point; });
}

Extent view_extent(const Frame& frame, const View& view) {
  return extent_of(frame, [&](const Vector& point) { return view.coordinates(point); });
}

Extent world_extent(vtkPolyData& surface) {
  return extent_of(surface, [](const Vector& point) { return point; });
}

Extent view_extent(vtkPolyData& surface, const View& view) {
  return extent_of(surface, [&](const Vector& point) { return view.coordinates(point); });
}

void aim(vtkRenderer& renderer, const View& view, const Extent& extent, double aspect, double margin) {
  Vector focus{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    focus[axis] = extent.centre(0) * view.right[axis] + extent.centre(1) * view.up[axis] + extent.centre(2) * view.eye[axis];
  }
  const double distance = 2.0 * (extent.size(0) + extent.size(1) + extent.size(2));
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(focus.data());
  camera.SetPosition(focus[0] + distance * view.eye[0], focus[1] + distance * view.eye[1], focus[2] + distance * view.eye[2]);
  camera.SetViewUp(view.up.data());
  camera.SetParallelScale(0.5 / (1.0 - 2.0 * margin) * std::max(extent.size(1), extent.size(0) / aspect));
  renderer.ResetCameraClippingRange();
}

}  // namespace menger::voxel
