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

}  // namespace

std::optional<Bend> bend_in_inflation(const fs::path& folder, double cell_edge_m) {
  if (!io::is_file(folder / "fields.pvd")) return std::nullopt;
  std::vector<io::CollectionEntry> states = io::read_collection(folder / "fields.pvd");
  std::erase_if(states, [&](const io::CollectionEntry& state) {
    return state.part != 0 || !std::isfinite(state.time_s) || !is_within(folder / state.file, folder);
  });
  std::ranges::stable_sort(states, {}, &io::CollectionEntry::time_s);
  if (states.size() < 2) return std::nullopt;
  const std::string told = io::read_in_child(folder / states.front().file, "VTK", [&] {
    const Bend bend = bend_of(read_points(folder / states.front().file, folder / states.back().file), cell_edge_m);
    return two_numbers(bend.sideways_m, bend.along_m);
  });
  const auto [sideways_m, along_m] = two_numbers_in(told);
  return Bend{.sideways_m = sideways_m, .along_m = along_m};
}

}  // namespace menger::evolution
