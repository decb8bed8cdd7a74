#pragma once

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <functional>
#include <vector>

namespace menger::tests {

using Place = std::array<double, 3>;  ///< m

/// Whether the points of a grid are where they are at rest, or where they have moved.
enum class PointsAre { at_rest, moved };

/// Returns a grid without cells whose points have moved, with displacement_m as data of its points.
/// @param rest_m where the points are at rest
/// @param moved_to where a point of this place at rest is now
inline vtkSmartPointer<vtkUnstructuredGrid> moved_grid(const std::vector<Place>& rest_m,
                                                       const std::function<Place(const Place&)>& moved_to, PointsAre points_are) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> moved;
  moved->SetName("displacement_m");
  moved->SetNumberOfComponents(3);
  for (const Place& rest : rest_m) {
    const Place now = moved_to(rest);
    points->InsertNextPoint((points_are == PointsAre::moved ? now : rest).data());
    moved->InsertNextTuple3(now[0] - rest[0], now[1] - rest[1], now[2] - rest[2]);
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(moved);
  return grid;
}

}  // namespace menger::tests
