#include "fem/locomotion/locomotion_picture.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "fem/picture/picture_parts.h"
#include "io/picture/chart.h"
#include "io/picture/path_panel.h"
#include "meshes/load_cases/observables.h"

namespace menger::fem {
namespace {

constexpr std::size_t most_plena_in_chart = 12;

/// Returns the outside of the body, without the walls of its chambers.
vtkSmartPointer<vtkUnstructuredGrid> outside_grid(const meshes::HexahedralMesh& mesh, std::span<const double> displacements_m) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    Point x = mesh.points[n];
    for (std::size_t i = 0; i < 3; ++i) x[i] += displacements_m[3 * n + i];
    points->InsertNextPoint(x.data());
  }
  grid->SetPoints(points);
  std::vector<bool> is_inside(mesh.label_names.size(), false);
  for (const meshes::Chamber& chamber : mesh.chambers)
    for (const std::size_t label : chamber.labels) is_inside[label] = true;
  for (const meshes::BoundaryFace& face : mesh.faces) {
    if (is_inside[face.label]) continue;
    std::array<vtkIdType, 4> corners{};
    std::transform(face.corners.begin(), face.corners.end(), corners.begin(),
                   [](std::size_t corner) { return static_cast<vtkIdType>(corner); });
    grid->InsertNextCell(VTK_QUAD, 4, corners.data());
  }
  return grid;
}

/// Returns the part of the ground that is shown, as one grid so that the camera includes it.
vtkSmartPointer<vtkUnstructuredGrid> ground_grid(const std::array<double, 6>& bounds, double height_m, double margin_m) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const double y : {bounds[2] - margin_m, bounds[3] + margin_m})
    for (const double x : {bounds[0] - margin_m, bounds[1] + margin_m}) points->InsertNextPoint(x, y, height_m);
  grid->SetPoints(points);
  const std::array<vtkIdType, 4> corners{0, 1, 3, 2};
  grid->InsertNextCell(VTK_QUAD, 4, corners.data());
  return grid;
}

void add_ground(vtkRenderer& renderer, vtkUnstructuredGrid& grid) {
  vtkNew<vtkPolyData> plane;
  plane->SetPoints(grid.GetPoints());
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({0, 1, 3, 2});
  plane->SetPolys(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(plane);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.90, 0.90, 0.88);
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

/// Draws the path of the centre of mass, just above the ground.
void add_path(vtkRenderer& renderer, const LocomotionResult& result) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(result.records.size()));
  for (const WalkRecord& record : result.records) {
    const Point& centre = record.centre_of_mass_m;
    lines->InsertCellPoint(points->InsertNextPoint(centre[0], centre[1], result.ground_height_m + 1e-3 * result.body_length_m));
  }
  vtkNew<vtkPolyData> path;
  path->SetPoints(points);
  path->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(path);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -1e5);  // visible through the body
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.74, 0.17, 0.16);
  actor->GetProperty()->SetLineWidth(3.0F * io::supersampling);
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

/// Colours the points by the length of their displacement, mm.
/// @return the greatest length
double add_displacements(vtkUnstructuredGrid& grid, std::span<const double> displacements_m) {
  vtkNew<vtkDoubleArray> displacements;
  displacements->SetName("displacement");
  double longest = std::numeric_limits<double>::min();
  for (std::size_t n = 0; n < displacements_m.size(); n += 3) {
    const double length_mm = 1e3 * std::hypot(displacements_m[n], displacements_m[n + 1], displacements_m[n + 2]);
    displacements->InsertNextValue(length_mm);
    longest = std::max(longest, length_mm);
  }
  grid.GetPointData()->SetScalars(displacements);
  return longest;
}

io::ChartPanel pressure_panel(const LocomotionResult& result) {
  io::ChartPanel panel{.x = {.title = "time (s)"}, .y = {.title = "pressure (kPa)", .least_span = 0.1}};
  for (std::size_t p = 0; p < std::min(result.plenum_names.size(), most_plena_in_chart); ++p) {
    io::ChartSeries series{.name = result.plenum_names.size() > 1 ? result.plenum_names[p] : ""};
    for (const WalkRecord& record : result.records) {
      series.x.push_back(record.time_s);
      series.y.push_back(1e-3 * record.plenum_pressures_Pa[p]);
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

}  // namespace

io::PictureOutcome draw_moved_body(const std::filesystem::path& file, const meshes::HexahedralMesh& mesh, const MovedBody& body,
                                   const LocomotionResult& result, const std::string& caption, const io::PictureStyle& style) {
  return io::write_picture(file, style, [&](vtkRenderWindow& window) {
    const auto moved = outside_grid(mesh, body.displacements_m);
    const double longest = add_displacements(*moved, body.displacements_m);
    const std::vector<double> rest(body.displacements_m.size(), 0.0);
    const auto start = outside_grid(mesh, rest);
    std::array<double, 6> bounds{};
    std::array<double, 6> first{};
    moved->GetBounds(bounds.data());
    start->GetBounds(first.data());
    for (std::size_t i = 0; i < bounds.size(); ++i)
      bounds.at(i) = i % 2 == 0 ? std::min(bounds.at(i), first.at(i)) : std::max(bounds.at(i), first.at(i));
    const auto ground = ground_grid(bounds, result.ground_height_m, 0.2 * result.body_length_m);
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1.0, 1.0, 1.0);
    window.AddRenderer(renderer);
    add_light(*renderer);
    add_ground(*renderer, *ground);
    add_body(*renderer, *moved, longest);
    add_outline(*renderer, *start);
    add_path(*renderer, result);
    const double pixels_per_m = aim(*renderer, {moved, start, ground}, style);
    add_scale_bar(*renderer, pixels_per_m, style);
    add_colour_bar(*renderer, "displacement (mm)", longest, style);
    add_caption(*renderer, caption, style);
  });
}

io::PictureOutcome plot_locomotion(const std::filesystem::path& file, const LocomotionResult& result, const std::string& title,
                                   const io::PictureStyle& style) {
  if (result.records.size() < 2) return {.missing = "a trajectory of at least two records"};
  std::array<io::ChartSeries, 3> over_time{{{.name = "x"}, {.name = "y"}, {.name = "z"}}};
  std::vector<double> x;
  std::vector<double> y;
  for (const WalkRecord& record : result.records) {
    const Point displacement = difference(record.centre_of_mass_m, result.records.front().centre_of_mass_m);
    for (std::size_t i = 0; i < 3; ++i) {
      over_time.at(i).x.push_back(record.time_s);
      over_time.at(i).y.push_back(displacement[i] / result.body_length_m);
    }
    x.push_back(displacement[0] / result.body_length_m);
    y.push_back(displacement[1] / result.body_length_m);
  }
  const io::ChartPanel displacement{
      .x = {.title = "time (s)"},
      .y = {.title = "displacement of the centre (body lengths)", .least_span = io::least_path_span},
      .series = {over_time.begin(), over_time.end()}};
  const io::ChartPanel path = io::path_panel(std::move(x), std::move(y));
  return io::write_chart(file, {.title = title, .panels = {displacement, path, pressure_panel(result)}}, style);
}

}  // namespace menger::fem
