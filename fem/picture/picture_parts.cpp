#include "fem/picture/picture_parts.h"

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkAlgorithmOutput.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFeatureEdges.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataConnectivityFilter.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fem/surfaces/point.h"
#include "io/picture/scale_bar.h"
#include "io/text/formatted.h"

namespace menger::fem {
namespace {

constexpr std::array<double, 3> ink{0.15, 0.17, 0.2};

/// The directions of the view: from the scene to the eye, to the right in the picture, and up in it. They are not symmetric, so
/// that faces and edges do not line up.
struct View {
  Point eye;
  Point right;
  Point up;
};

View view() {
  constexpr double azimuth = -1.15;   // radians from the x axis
  constexpr double elevation = 0.42;  // radians above the ground
  const Point eye{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  const Point right{-std::sin(azimuth), std::cos(azimuth), 0.0};
  return {eye, right, cross(eye, right)};
}

/// Returns a colour map from blue over light to red, which colour-blind readers can distinguish, too.
vtkSmartPointer<vtkColorTransferFunction> colours(double highest) {
  auto map = vtkSmartPointer<vtkColorTransferFunction>::New();
  map->SetColorSpaceToLab();
  map->AddRGBPoint(0.0, 0.16, 0.25, 0.52);
  map->AddRGBPoint(0.35 * highest, 0.36, 0.66, 0.78);
  map->AddRGBPoint(0.65 * highest, 0.97, 0.88, 0.62);
  map->AddRGBPoint(highest, 0.74, 0.17, 0.16);
  return map;
}

int font_size(const io::PictureStyle& style) { return io::supersampling * style.height_px / 40; }

void add_text(vtkRenderer& renderer, const std::string& text, double x, double y, const io::PictureStyle& style) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->SetFontSize(font_size(style));
  actor->GetTextProperty()->SetColor(ink[0], ink[1], ink[2]);
  actor->GetTextProperty()->SetJustificationToCentered();
  actor->SetPosition(x, y);
  renderer.AddViewProp(actor);
}

vtkSmartPointer<vtkFeatureEdges> sharp_edges(vtkAlgorithmOutput* surface) {
  auto edges = vtkSmartPointer<vtkFeatureEdges>::New();
  edges->SetInputConnection(surface);
  edges->SetFeatureAngle(30.0);
  edges->ColoringOff();
  edges->ManifoldEdgesOff();
  return edges;
}

/// Adds lines, drawn in front of the surface in which they lie.
void add_lines(vtkRenderer& renderer, vtkAlgorithmOutput* lines, const std::array<double, 3>& colour, float width) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(lines);
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -1e5);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->SetLineWidth(width * io::supersampling);
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

}  // namespace

void add_light(vtkRenderer& renderer) {
  vtkNew<vtkLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->SetPositional(false);
  sun->SetPosition(0.35, -0.75, 0.85);
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  renderer.AutomaticLightCreationOff();
  renderer.AddLight(sun);
}

void add_body(vtkRenderer& renderer, vtkUnstructuredGrid& grid, double highest) {
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(&grid);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(surface->GetOutputPort());
  normals->SetFeatureAngle(35.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->SetLookupTable(colours(highest));
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.45);
  actor->GetProperty()->SetDiffuse(0.65);
  renderer.AddActor(actor);
}

void add_outline(vtkRenderer& renderer, vtkUnstructuredGrid& grid) {
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(&grid);
  add_lines(renderer, sharp_edges(surface->GetOutputPort())->GetOutputPort(), ink, 1.2F);
}

void add_faint_outline(vtkRenderer& renderer, vtkUnstructuredGrid& grid, double below) {
  constexpr std::array<double, 3> grey{0.55, 0.57, 0.62};
  Point outermost{std::numeric_limits<double>::max(), 0.0, 0.0};  // a point of the outer surface, for it has the least x
  for (vtkIdType n = 0; n < grid.GetNumberOfPoints(); ++n) {
    Point x{};
    grid.GetPoint(n, x.data());
    if (x[0] < outermost[0]) outermost = x;
  }
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(&grid);
  vtkNew<vtkPolyDataConnectivityFilter> outer;
  outer->SetInputConnection(surface->GetOutputPort());
  outer->SetExtractionModeToClosestPointRegion();
  outer->SetClosestPoint(outermost.data());
  vtkNew<vtkClipPolyData> clip;
  const auto edges = sharp_edges(outer->GetOutputPort());
  clip->SetInputConnection(edges->GetOutputPort());
  clip->SetValue(below);
  clip->InsideOutOn();
  add_lines(renderer, clip->GetOutputPort(), grey, 1.0F);
}

double aim(vtkRenderer& renderer, const std::vector<vtkUnstructuredGrid*>& grids, const io::PictureStyle& style) {
  const View from = view();
  const std::array<Point, 3> axes{from.right, from.up, from.eye};
  Point low;
  Point high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (vtkUnstructuredGrid* grid : grids) {
    for (vtkIdType n = 0; n < grid->GetNumberOfPoints(); ++n) {
      Point x{};
      grid->GetPoint(n, x.data());
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], dot(axes[i], x));
        high[i] = std::max(high[i], dot(axes[i], x));
      }
    }
  }
  Point focus{};
  for (std::size_t i = 0; i < 3; ++i) focus = sum(focus, scaled(0.5 * (low[i] + high[i]), axes[i]));
  const double aspect = static_cast<double>(style.width_px) / style.height_px;
  constexpr double filled_height = 0.72;  // the rest is for caption and scale bar
  constexpr double filled_width = 0.70;   // the rest is for the colour bar
  const double half_height = 0.5 * std::max((high[1] - low[1]) / filled_height, (high[0] - low[0]) / (aspect * filled_width));
  const Point eye = sum(focus, scaled(2.0 * norm(difference(high, low)), from.eye));
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(focus.data());
  camera.SetPosition(eye.data());
  camera.SetViewUp(from.up.data());
  camera.SetParallelScale(half_height);
  camera.SetWindowCenter(0.14, 0.0);  // makes room on the right
  renderer.ResetCameraClippingRange();
  return io::supersampling * style.height_px / (2.0 * half_height);
}

void add_scale_bar(vtkRenderer& renderer, double pixels_per_m, const io::PictureStyle& style) {
  const double length_m = io::scale_bar_length(0.25 * io::supersampling * style.width_px / pixels_per_m);
  const double length = length_m * pixels_per_m;
  const double x = 0.04 * io::supersampling * style.width_px;
  const double y = 0.05 * io::supersampling * style.height_px;
  const double tick = 0.008 * io::supersampling * style.height_px;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  const auto add_line = [&](double x0, double y0, double x1, double y1) {
    const vtkIdType first = points->InsertNextPoint(x0, y0, 0.0);
    const vtkIdType second = points->InsertNextPoint(x1, y1, 0.0);
    lines->InsertNextCell({first, second});
  };
  add_line(x, y, x + length, y);
  add_line(x, y - tick, x, y + tick);
  add_line(x + length, y - tick, x + length, y + tick);
  vtkNew<vtkPolyData> bar;
  bar->SetPoints(points);
  bar->SetLines(lines);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(bar);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
  actor->GetProperty()->SetLineWidth(2.5F * io::supersampling);
  renderer.AddViewProp(actor);
  add_text(renderer, io::shown(1e3 * length_m, 6) + " mm", x + 0.5 * length, y + 2.0 * tick, style);
}

void add_colour_bar(vtkRenderer& renderer, const std::string& title, double highest, const io::PictureStyle& style) {
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colours(highest));
  bar->SetTitle(title.c_str());
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%.3g");
  bar->SetUnconstrainedFontSize(true);
  for (vtkTextProperty* property : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
    property->SetColor(ink[0], ink[1], ink[2]);
    property->SetFontSize(font_size(style));
    property->BoldOff();
    property->ItalicOff();
    property->ShadowOff();
  }
  bar->SetVerticalTitleSeparation(font_size(style));
  bar->SetPosition(0.80, 0.15);
  bar->SetWidth(0.17);
  bar->SetHeight(0.70);
  bar->SetBarRatio(0.2);
  bar->SetTextPad(font_size(style) / 3);
  bar->SetMaximumNumberOfColors(256);
  renderer.AddViewProp(bar);
}

void add_caption(vtkRenderer& renderer, const std::string& caption, const io::PictureStyle& style) {
  add_text(renderer, caption, 0.5 * io::supersampling * style.width_px, 0.93 * io::supersampling * style.height_px, style);
}

}  // namespace menger::fem
