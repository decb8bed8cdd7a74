#include "voxel/validation/validation_scene.h"

#include <vtkAppendFilter.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <system_error>
#include <utility>

#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "io/text/whole_file.h"
#include "io/vtk/grid_arrays.h"
#include "io/vtk/vtk_file.h"
#include "voxel/picture/vtk_output.h"
#include "voxel/validation/body_boxes.h"
#include "voxel/validation/kept_fields.h"
#include "voxel/validation/rigid_part.h"
#include "voxel/validation/side_by_side_picture.h"

namespace menger::voxel {

namespace {

namespace fs = std::filesystem;
using State = std::vector<double>;

void write_state(const fs::path& file, vtkUnstructuredGrid& grid, std::size_t row, const State& state) {
  io::add_field_values(grid, "TimeValue", std::array{static_cast<double>(row)});
  io::add_field_values(grid, "pressure_Pa", std::array{state.front()});
  if (state.size() > 1) io::add_field_values(grid, "imposed", std::array{state[1]});
  io::write_vtu(file, grid);
}

/// @param rest the same boxes at rest, from which displacements are counted
vtkSmartPointer<vtkUnstructuredGrid> grid_of(const BodyBoxes& boxes, const BodyBoxes& rest) {
  const auto count = static_cast<vtkIdType>(boxes.corners_m.size());
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> material;
  material->SetName("material");
  std::vector<double> displacements;
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->AllocateExact(count, 8 * count);
  for (std::size_t voxel = 0; voxel < boxes.corners_m.size(); ++voxel) {
    std::array<vtkIdType, 8> ids{};
    for (std::size_t corner = 0; corner < ids.size(); ++corner) {
      const BodyBoxes::Point& place = boxes.corners_m[voxel].at(corner);
      ids.at(corner) = points->InsertNextPoint(place.data());
      for (std::size_t axis = 0; axis < 3; ++axis)
        displacements.push_back(place.at(axis) - rest.corners_m[voxel].at(corner).at(axis));
    }
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
    material->InsertNextValue(boxes.material[voxel]);
  }
  grid->SetPoints(points);
  io::add_floats(*grid->GetPointData(), "displacement_m", displacements, 3);
  grid->GetPointData()->SetActiveVectors("displacement_m");
  grid->GetCellData()->AddArray(material);
  io::add_floats(*grid->GetCellData(), "volume_ratio", boxes.volume_ratio);
  grid->GetCellData()->SetActiveScalars("volume_ratio");
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> as_grid(vtkPolyData& surface) {
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(&surface);
  append->Update();
  vtkSmartPointer<vtkUnstructuredGrid> grid = append->GetOutput();
  grid->GetPointData()->SetActiveVectors("displacement_m");
  grid->GetCellData()->SetActiveScalars("largest_stretch");
  return grid;
}

std::string numbered(const std::string& kind, std::size_t row) { return "worst/" + kind + "_" + io::padded(row, 4) + ".vtu"; }

/// Removes the files of an earlier run, and no others.
void remove_earlier(const fs::path& folder) {
  io::remove_files(folder, {"worst.pvd", "worst.png", "worst/elements_*.vtu", "worst/voxels_*.vtu"});
}

/// The surrogate as boxes, at rest and by row of the curve.
struct SurrogateStates {
  BodyBoxes rest;
  std::map<std::size_t, BodyBoxes> by_row;
};

SurrogateStates surrogate_states(const SideBySide& sides, const std::vector<State>& states) {
  SurrogateStates found;
  const meshes::LoadCase& load_case = sides.comparison->load_case();
  const State nothing_done(states.front().size(), 0.0);
  (void)visit_states(sides.parameters, load_case, {nothing_done},
                     [&](std::size_t, const Equilibrium& equilibrium) { found.rest = body_boxes(equilibrium); });
  // Only states with a response in the comparison, none beyond.
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < states.size(); ++row) {
    const auto& response_rows = sides.comparison->response_rows;
    if (response_rows.empty() || response_rows[row]) rows.push_back(row);
  }
  std::vector<State> shown;
  shown.reserve(rows.size());
  for (const std::size_t row : rows) shown.push_back(states[row]);
  if (shown.empty()) return found;
  (void)visit_states(sides.parameters, load_case, shown, [&](std::size_t n, const Equilibrium& equilibrium) {
    found.by_row.emplace(rows[n], body_boxes(equilibrium));
  });
  return found;
}

std::string caption_of(const CurveComparison& comparison, const State& state) {
  return comparison.load_case().name + " at " + io::kilopascals(state.front());
}

}  // namespace

SideBySideOutcome write_side_by_side(const fs::path& folder, const SideBySide& sides, bool with_picture) {
  remove_earlier(folder);
  SideBySideOutcome outcome;
  const std::vector<State> states = states_of(sides.comparison->curve);
  SurrogateStates surrogate = surrogate_states(sides, states);
  const FieldsByRow fields = sides.fields ? fields_by_row(*sides.fields, states) : FieldsByRow{};
  if (!sides.fields) {
    outcome.notes.emplace_back("there are no fields of finite elements beside the curve: worst.pvd shows only the surrogate");
  } else if (fields.size() != states.size()) {
    outcome.notes.push_back(sides.fields->string() + ": has steps for " + std::to_string(fields.size()) + " of " +
                            std::to_string(states.size()) + " rows of the curve: only those rows are shown");
  }
  std::vector<CollectionEntry> entries;
  std::map<std::size_t, Eigen::Isometry3d> elements_by_row;  // their rigid motions
  std::vector<std::size_t> shown;
  // The rigid motion of a free body depends on its support and is not part of its response.
  const bool is_free = sides.comparison->load_case().kind == meshes::LoadCaseKind::inflation;
  for (auto& [row, body] : surrogate.by_row) {
    const auto elements = fields.find(row);
    if (sides.fields && elements == fields.end()) continue;
    const auto time = static_cast<double>(row);
    Eigen::Isometry3d of_elements = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d motion = is_free ? rigid_part(surrogate.rest, body).inverse() : Eigen::Isometry3d::Identity();
    if (sides.fields) {
      const vtkSmartPointer<vtkPolyData> surface = deformed_surface(elements->second);
      entries.push_back({time, numbered("elements", row), 0, "finite elements"});
      write_state(folder / entries.back().file, *as_grid(*surface), row, states[row]);
      if (is_free) of_elements = rigid_part(*surface);
      motion = of_elements * motion;
    }
    body = moved(std::move(body), motion);
    elements_by_row.emplace(row, of_elements);
    entries.push_back({time, numbered("voxels", row), 1, "voxels"});
    write_state(folder / entries.back().file, *grid_of(body, surrogate.rest), row, states[row]);
    shown.push_back(row);
  }
  outcome.states = shown.size();
  if (outcome.states == 0) {
    outcome.notes.emplace_back(
        "no state of the worst case has both an equilibrium of the surrogate and fields: nothing is shown");
    return outcome;
  }
  write_collection(folder / "worst.pvd", entries);
  if (!with_picture) return outcome;
  const auto not_before = std::lower_bound(shown.begin(), shown.end(), sides.pictured_row);
  const std::size_t row = not_before == shown.end() ? shown.back() : *not_before;
  const vtkSmartPointer<vtkPolyData> elements = sides.fields ? deformed_surface(fields.at(row)) : nullptr;
  const BodyBoxes rest = moved(surrogate.rest, elements_by_row.at(row));
  outcome.picture = draw_side_by_side(folder / "worst.png", {.elements = elements,
                                                             .surrogate = &surrogate.by_row.at(row),
                                                             .rest = &rest,
                                                             .caption = caption_of(*sides.comparison, states[row]),
                                                             .finding = row == sides.pictured_row ? sides.finding : ""});
  return outcome;
}

}  // namespace menger::voxel
