#include "voxel/validation/side_by_side_picture.h"

#include <vtkBoundingBox.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkPointLocator.h>
#include <vtkPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/picture/scale_bar.h"
#include "io/text/formatted.h"
#include "voxel/picture/picture_parts.h"
#include "voxel/picture/picture_view.h"

namespace menger::voxel {

namespace {

/// The sharp edges of the surface of boxes that touch. Corners in one place become one, so that the sides within the body go.
vtkSmartPointer<vtkPolyData> outline_of(const BodyBoxes& boxes) {
  constexpr double same_place = 0.01;  // of the size of the first box: boxes at rest may miss each other by rounding
  vtkBoundingBox box;
  for (const auto& corners : boxes.corners_m) {
    for (const BodyBoxes::Point& corner : corners) box.AddPoint(corner[0], corner[1], corner[2]);
  }
  vtkBoundingBox first;
  for (const BodyBoxes::Point& corner : boxes.corners_m.front()) first.AddPoint(corner[0], corner[1], corner[2]);
  std::array<double, 6> bounds{};
  box.GetBounds(bounds.data());
  vtkNew<vtkPoints> points;
  vtkNew<vtkPointLocator> places;
  places->SetTolerance(same_place * first.GetMaxLength());
  places->InitPointInsertion(points, bounds.data());
  vtkNew<vtkUnstructuredGrid> grid;
  for (const auto& corners : boxes.corners_m) {
    std::array<vtkIdType, 8> ids{};
    for (std::size_t n = 0; n < ids.size(); ++n) places->InsertUniquePoint(corners.at(n).data(), ids.at(n));
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
  }
  grid->SetPoints(points);
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(grid);
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(surface->GetOutputPort());
  edges->SetFeatureAngle(30.0);
  edges->ColoringOff();
  edges->ManifoldEdgesOff();
  edges->Update();
  return edges->GetOutput();
}

void fill(vtkRenderWindow& window, const SideBySidePicture& picture, const io::PictureStyle& style) {
  const View view = isometric_view();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  add_light(*renderer);
  std::vector<vtkSmartPointer<vtkPolyData>> bodies;
  if (picture.elements != nullptr) bodies.emplace_back(picture.elements);
  // One colour for all boxes, because the body is of one silicone.
  const BodyBoxes& boxes = *picture.surrogate;
  bodies.push_back(box_surface(boxes.corners_m, std::vector<meshes::Material>(boxes.corners_m.size(), 1)));
  const vtkSmartPointer<vtkPolyData> outline = outline_of(*picture.rest);
  double widest = 0.0;
  for (const auto& body : bodies) widest = std::max(widest, view_extent(*body, view).size(0));
  Extent seen;
  std::vector<double> middles;
  double left = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Extent own = view_extent(*bodies[i], view);
    const Vector shift = view.across(left - own.low[0], -own.low[1]);
    const auto body = moved(*bodies[i], shift);
    const bool is_surrogate = i + 1 == bodies.size();
    if (is_surrogate) add_robot(*renderer, *body, 1.5 * io::supersampling);
    if (!is_surrogate) add_elements(*renderer, *body, 0.0);
    const auto rest = moved(*outline, shift);
    add_lines(*renderer, *rest, 1.5 * io::supersampling);
    const Extent placed = view_extent(*body, view);
    seen.unite(placed);
    middles.push_back(placed.centre(0));
    left = placed.high[0] + 0.3 * widest;
  }
  const double bar_m = io::scale_bar_length(0.25 * widest);
  add_scale_bar(*renderer, view, seen, bar_m);
  window.AddRenderer(renderer);
  const double aspect = static_cast<double>(style.width_px) / style.height_px;
  constexpr double margin = 0.22;  // for the captions, and the bar above them also where bodies are as high as the picture
  aim(*renderer, view, seen, aspect, margin);
  const double picture_width = 2.0 * renderer->GetActiveCamera()->GetParallelScale() * aspect;
  const int font_size = style.height_px / 36;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    std::string text = i + 1 == middles.size() ? "surrogate" : "finite elements";
    text.append(", ").append(picture.caption);
    add_caption(*renderer, text, 0.5 + (middles[i] - seen.centre(0)) / picture_width, font_size);
  }
  add_caption(*renderer, "bar: " + io::shown(1e3 * bar_m, 3) + " mm; thin lines: at rest", 0.5, font_size, 0.09);
  if (!picture.finding.empty()) add_caption(*renderer, picture.finding, 0.5, font_size, 0.94);
}

}  // namespace

io::PictureOutcome draw_side_by_side(const std::filesystem::path& file, const SideBySidePicture& picture,
                                     const io::PictureStyle& style) {
  return io::write_picture(file, style, [&](vtkRenderWindow& window) { fill(window, picture, style); });
}

}  // namespace menger::voxel
