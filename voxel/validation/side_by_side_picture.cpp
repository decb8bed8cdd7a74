#include "voxel/validation/side_by_side_picture.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <vector>

#include "voxel/picture/picture_parts.h"
#include "voxel/picture/picture_view.h"

namespace menger::voxel {

namespace {

constexpr std::array<unsigned char, 3> voxel_colour{72, 196, 212};

vtkSmartPointer<vtkPolyData> surface_of(const BodyBoxes& boxes) {
  constexpr std::array<std::array<vtkIdType, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> quads;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const auto& corners : boxes.corners_m) {
    const vtkIdType first = points->GetNumberOfPoints();
    for (const BodyBoxes::Point& corner : corners) points->InsertNextPoint(corner.data());
    for (const auto& face : faces) {
      quads->InsertNextCell({first + face[0], first + face[1], first + face[2], first + face[3]});
      colours->InsertNextTypedTuple(voxel_colour.data());
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(quads);
  surface->GetCellData()->SetScalars(colours);
  return surface;
}

Extent extent_of(vtkPolyData& surface, const View& view) {
  Extent extent;
  for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
    Vector point{};
    surface.GetPoint(i, point.data());
    extent.add(view.coordinates(point));
  }
  return extent;
}

/// A way across the picture, to the right and up.
Vector in_world(const View& view, double right, double up) {
  Vector way{};
  for (std::size_t axis = 0; axis < 3; ++axis) way.at(axis) = right * view.right.at(axis) + up * view.up.at(axis);
  return way;
}

void add_elements(vtkRenderer& renderer, vtkPolyData& surface) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&surface);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.90, 0.78, 0.60);
  actor->GetProperty()->SetAmbient(0.42);
  actor->GetProperty()->SetDiffuse(0.72);
  renderer.AddActor(actor);
}

void fill(vtkRenderWindow& window, const std::vector<vtkSmartPointer<vtkPolyData>>& bodies, const std::string& caption,
          const io::PictureStyle& style) {
  const View view = isometric_view();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  add_light(*renderer);
  double widest = 0.0;
  for (const auto& body : bodies) widest = std::max(widest, extent_of(*body, view).size(0));
  Extent seen;
  std::vector<double> middles;
  double left = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Extent own = extent_of(*bodies[i], view);
    const auto body = moved(*bodies[i], in_world(view, left - own.low[0], -own.low[1]));
    const bool is_surrogate = i + 1 == bodies.size();
    if (is_surrogate) add_robot(*renderer, *body, 1.5 * io::supersampling);
    if (!is_surrogate) add_elements(*renderer, *body);
    const Extent placed = extent_of(*body, view);
    seen.unite(placed);
    middles.push_back(placed.centre(0));
    left = placed.high[0] + 0.3 * widest;
  }
  window.AddRenderer(renderer);
  const double aspect = static_cast<double>(style.width_px) / style.height_px;
  constexpr double margin = 0.10;  // for the captions
  aim(*renderer, view, seen, aspect, margin);
  const double picture_width = 2.0 * renderer->GetActiveCamera()->GetParallelScale() * aspect;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    std::string text = i + 1 == middles.size() ? "surrogate" : "finite elements";
    text.append(", ").append(caption);
    add_caption(*renderer, text, 0.5 + (middles[i] - seen.centre(0)) / picture_width, style.height_px / 36);
  }
}

}  // namespace

io::PictureOutcome draw_side_by_side(const std::filesystem::path& file, vtkPolyData* elements, const BodyBoxes& surrogate,
                                     const std::string& caption, const io::PictureStyle& style) {
  std::vector<vtkSmartPointer<vtkPolyData>> bodies;
  if (elements != nullptr) bodies.emplace_back(elements);
  bodies.push_back(surface_of(surrogate));
  return io::write_picture(file, style, [&](vtkRenderWindow& window) { fill(window, bodies, caption, style); });
}

}  // namespace menger::voxel
