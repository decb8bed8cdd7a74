#include "voxel/picture/picture_parts.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyLineSource.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <cassert>
#include <vector>

#include "io/picture/picture.h"
#include "voxel/picture/cube.h"

namespace menger::voxel {
namespace {

/// Of lines and words.
constexpr std::array<double, 3> ink{0.15, 0.17, 0.2};

/// Direction to the light. The three visible sides of a resting cube get three different brightnesses.
constexpr Vector light_direction{0.25, -0.47, 0.85};

/// Adds a surface or lines in one colour without shading.
vtkSmartPointer<vtkActor> add_flat(vtkRenderer& renderer, vtkPolyData& surface, const std::array<double, 3>& colour) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&surface);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
  return actor;
}

vtkSmartPointer<vtkPolyData> line_between(const Vector& from, const Vector& to) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({points->InsertNextPoint(from.data()), points->InsertNextPoint(to.data())});
  auto line = vtkSmartPointer<vtkPolyData>::New();
  line->SetPoints(points);
  line->SetLines(lines);
  return line;
}

}  // namespace

vtkSmartPointer<vtkPolyData> box_surface(std::span<const std::array<Vector, 8>> corners_m,
                                         std::span<const meshes::Material> materials) {
  constexpr std::array<std::array<vtkIdType, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  assert(corners_m.size() == materials.size());
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> quads;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (std::size_t box = 0; box < corners_m.size(); ++box) {
    const vtkIdType first = points->GetNumberOfPoints();
    for (const Vector& corner : corners_m[box]) points->InsertNextPoint(corner.data());
    for (const auto& face : faces) {
      quads->InsertNextCell({first + face[0], first + face[1], first + face[2], first + face[3]});
      colours->InsertNextTypedTuple(material_colours.at(materials[box] - 1U).data());
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(quads);
  surface->GetCellData()->SetScalars(colours);
  return surface;
}

vtkSmartPointer<vtkPolyData> robot_surface(const Placed& robot) {
  const Frame& frame = *robot.frame;
  std::vector<std::array<Vector, 8>> corners_m;
  for (std::size_t voxel = 0; voxel < frame.position_m.size(); ++voxel) {
    corners_m.push_back(cube_corners_m(frame, voxel));
    for (Vector& corner : corners_m.back())
      for (std::size_t axis = 0; axis < 3; ++axis) corner.at(axis) += robot.shift.at(axis);
  }
  return box_surface(corners_m, frame.material);
}

void add_robot(vtkRenderer& renderer, vtkPolyData& surface, double line_width) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&surface);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty& property = *actor->GetProperty();
  property.SetInterpolationToFlat();
  property.SetAmbient(0.42);
  property.SetDiffuse(0.72);
  property.EdgeVisibilityOn();
  property.SetEdgeColor(0.10, 0.16, 0.20);
  property.SetLineWidth(static_cast<float>(line_width));
  renderer.AddActor(actor);
}

void add_elements(vtkRenderer& renderer, vtkPolyData& surface, double line_width) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&surface);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty& property = *actor->GetProperty();
  property.SetColor(0.90, 0.78, 0.60);
  property.SetAmbient(0.42);
  property.SetDiffuse(0.72);
  if (line_width > 0.0) {
    property.SetInterpolationToFlat();
    property.EdgeVisibilityOn();
    property.SetEdgeColor(0.55, 0.45, 0.32);
    property.SetLineWidth(static_cast<float>(line_width));
  }
  renderer.AddActor(actor);
}

vtkSmartPointer<vtkPolyData> moved(vtkPolyData& surface, const Vector& shift) {
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
    Vector point{};
    surface.GetPoint(i, point.data());
    for (std::size_t axis = 0; axis < 3; ++axis) point.at(axis) += shift.at(axis);
    points->InsertNextPoint(point.data());
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(&surface);
  result->SetPoints(points);
  return result;
}

Vector shadow_of(const Vector& point, double ground_height) {
  const double way = (point[2] - ground_height) / light_direction[2];
  return {point[0] - way * light_direction[0], point[1] - way * light_direction[1], ground_height};
}

void add_shadow(vtkRenderer& renderer, vtkPolyData& surface, double ground_height, double height) {
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
    Vector point{};
    surface.GetPoint(i, point.data());
    point = shadow_of(point, ground_height);
    points->InsertNextPoint(point[0], point[1], height);
  }
  vtkNew<vtkPolyData> shadow;
  shadow->SetPoints(points);
  shadow->SetPolys(surface.GetPolys());
  add_flat(renderer, *shadow, {0.80, 0.81, 0.83});
}

void add_floor(vtkRenderer& renderer, const Extent& ground, double height) {
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(ground.low[0], ground.low[1], height);
  plane->SetPoint1(ground.high[0], ground.low[1], height);
  plane->SetPoint2(ground.low[0], ground.high[1], height);
  plane->Update();
  add_flat(renderer, *plane->GetOutput(), {0.925, 0.93, 0.94});
}

void add_trail(vtkRenderer& renderer, std::span<const Vector> trail) {
  if (trail.size() < 2) return;
  vtkNew<vtkPolyLineSource> line;
  line->Resize(static_cast<int>(trail.size()));
  for (int i = 0; const Vector& point : trail) line->SetPoint(i++, point[0], point[1], point[2]);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(line->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.2, 0.22, 0.28);
  actor->GetProperty()->SetLineWidth(4.0F * io::supersampling);
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

void add_light(vtkRenderer& renderer) {
  vtkNew<vtkLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->SetPositional(false);
  sun->SetPosition(light_direction.data());
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  renderer.AutomaticLightCreationOff();
  renderer.AddLight(sun);
}

void add_lines(vtkRenderer& renderer, vtkPolyData& lines, double line_width) {
  const vtkSmartPointer<vtkActor> actor = add_flat(renderer, lines, ink);
  // drawn in front of what hides them
  actor->GetMapper()->SetResolveCoincidentTopologyToPolygonOffset();
  actor->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -1e5);
  actor->GetProperty()->SetLineWidth(static_cast<float>(line_width));
}

void add_scale_bar(vtkRenderer& renderer, const View& view, const Extent& seen, double length_m) {
  const auto at = [&](double to_right) {
    Vector place{};
    const double depth = seen.high[2];
    const double height = seen.low[1] - 0.03 * seen.size(1);
    for (std::size_t axis = 0; axis < 3; ++axis)
      place.at(axis) = to_right * view.right.at(axis) + height * view.up.at(axis) + depth * view.eye.at(axis);
    return place;
  };
  add_lines(renderer, *line_between(at(seen.centre(0) - 0.5 * length_m), at(seen.centre(0) + 0.5 * length_m)),
            2.5 * io::supersampling);
}

void add_ground_axes(vtkRenderer& renderer, const Vector& corner, double length_m) {
  for (const std::size_t axis : {0U, 1U}) {
    Vector end = corner;
    end.at(axis) += length_m;
    add_lines(renderer, *line_between(corner, end), 2.0 * io::supersampling);
  }
}

void add_caption(vtkRenderer& renderer, const std::string& caption, double across, int font_size, double up) {
  vtkNew<vtkTextActor> text;
  text->SetInput(caption.c_str());
  text->GetTextProperty()->SetFontSize(io::supersampling * font_size);
  text->GetTextProperty()->SetColor(ink[0], ink[1], ink[2]);
  text->GetTextProperty()->SetJustificationToCentered();
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(across, up);
  renderer.AddViewProp(text);
}

}  // namespace menger::voxel
