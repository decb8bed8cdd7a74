#include "evolution/posture/bend.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "evolution/posture/frame_grid.h"
#include "evolution/posture/near_end.h"
#include "evolution/posture/two_numbers.h"
#include "io/process/child_reading.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/vtk/collection.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using Place = std::array<double, 3>;

MovedPoints read_points(const fs::path& first, const fs::path& last) {
  const auto rest = read_frame_grid(first);
  const auto now = read_frame_grid(last);
  vtkDataArray* moved = now->GetPointData()->GetArray("displacement_m");
  if (moved == nullptr || now->GetNumberOfPoints() != rest->GetNumberOfPoints())
    throw io::InputError(last.string() + ": is of another mesh than the first state");
  MovedPoints points;
  for (vtkIdType n = 0; n < rest->GetNumberOfPoints(); ++n) {
    Place place{};
    rest->GetPoint(n, place.data());
    points.rest_m.push_back(place);
    for (std::size_t axis = 0; axis < 3; ++axis) place.at(axis) += moved->GetComponent(n, static_cast<int>(axis));
    points.now_m.push_back(place);
  }
  return points;
}

/// Points that a file has where they are now, with their displacement from rest.
MovedPoints read_deformed_points(const fs::path& file) {
  const auto now = read_frame_grid(file);
  vtkDataArray* moved = now->GetPointData()->GetArray("displacement_m");
  if (moved == nullptr) throw io::InputError(file.string() + ": has no displacement_m at its points");
  MovedPoints points;
  for (vtkIdType n = 0; n < now->GetNumberOfPoints(); ++n) {
    Place place{};
    now->GetPoint(n, place.data());
    points.now_m.push_back(place);
    for (std::size_t axis = 0; axis < 3; ++axis) place.at(axis) -= moved->GetComponent(n, static_cast<int>(axis));
    points.rest_m.push_back(place);
  }
  return points;
}

Bend bend_of(const MovedPoints& points, double cell_edge_m) {
  const std::size_t longest = longest_axis(points);
  const MovedPoints far = points_near_end(points, longest, true, 0.0);
  const Place far_now_m = motion_of_near_end(points, cell_edge_m).taken_out(mean_of(far.now_m));
  const Place far_rest_m = mean_of(far.rest_m);
  Bend bend;
  double across2_m2 = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double moved_m = far_now_m.at(i) - far_rest_m.at(i);
    if (i == longest)
      bend.along_m = moved_m;
    else
      across2_m2 += moved_m * moved_m;
  }
  bend.sideways_m = std::sqrt(across2_m2);
  return bend;
}

/// Reads points in a process of its own, since a damaged file can crash the library that reads it.
template <class Read>
Bend bend_in_child(const fs::path& file, double cell_edge_m, Read read) {
  const std::string told = io::read_in_child(file, "VTK", [&] {
    const Bend bend = bend_of(read(), cell_edge_m);
    return two_numbers(bend.sideways_m, bend.along_m);
  });
  const auto [sideways_m, along_m] = two_numbers_in(told);
  return Bend{.sideways_m = sideways_m, .along_m = along_m};
}

}  // namespace

std::optional<Bend> bend_in_inflation(const fs::path& folder, double cell_edge_m) {
  if (!io::is_file(folder / "fields.pvd")) return std::nullopt;
  std::vector<io::CollectionEntry> states = io::read_collection(folder / "fields.pvd");
  std::erase_if(states, [&](const io::CollectionEntry& state) {
    return state.part != 0 || !std::isfinite(state.time_s) || !is_within(folder / state.file, folder);
  });
  std::ranges::stable_sort(states, {}, &io::CollectionEntry::time_s);
  if (states.size() < 2) return std::nullopt;
  const fs::path first = folder / states.front().file;
  return bend_in_child(first, cell_edge_m, [&] { return read_points(first, folder / states.back().file); });
}

std::optional<ComparedBend> bend_in_validation(const fs::path& folder, std::size_t row, double cell_edge_m) {
  if (!io::is_file(folder / "worst.pvd")) return std::nullopt;
  const std::vector<io::CollectionEntry> states = io::read_collection(folder / "worst.pvd");
  const auto bend = [&](int part) -> std::optional<Bend> {
    const auto state = std::ranges::find_if(states, [&](const io::CollectionEntry& one) {
      return one.part == part && one.time_s == static_cast<double>(row) && is_within(folder / one.file, folder);
    });
    if (state == states.end()) return std::nullopt;
    const fs::path file = folder / state->file;
    return bend_in_child(file, cell_edge_m, [&] { return read_deformed_points(file); });
  };
  const std::optional<Bend> elements = bend(0);
  const std::optional<Bend> voxels = elements ? bend(1) : std::nullopt;
  if (!voxels) return std::nullopt;
  return ComparedBend{.elements = *elements, .voxels = *voxels};
}

}  // namespace menger::evolution
