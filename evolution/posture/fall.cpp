#include "evolution/posture/fall.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <system_error>
#include <vector>

#include "evolution/posture/frame_grid.h"
#include "evolution/posture/two_numbers.h"
#include "io/process/child_reading.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/vtk/collection.h"
#include "meshes/load_cases/lean.h"
#include "meshes/load_cases/outermost_points.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using Place = std::array<double, 3>;

std::vector<Place> points_of(vtkUnstructuredGrid& grid) {
  std::vector<Place> points(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  for (std::size_t n = 0; n < points.size(); ++n) grid.GetPoint(static_cast<vtkIdType>(n), points[n].data());
  return points;
}

/// How a body stands in its frames, by the outermost points of its first.
class Posture {
 public:
  explicit Posture(const std::vector<Place>& at_rest_m) : count_(at_rest_m.size()), outermost_(at_rest_m) {}

  /// Returns the body's own upright axis. @throws io::InputError if the frame is of another mesh
  [[nodiscard]] Place upright(const fs::path& file) const {
    const auto grid = read_frame_grid(file);
    vtkDataArray* moved = grid->GetPointData()->GetArray("displacement_m");
    if (moved == nullptr || static_cast<std::size_t>(grid->GetNumberOfPoints()) != count_)
      throw io::InputError(file.string() + ": is of another mesh than the first frame");
    std::vector<double> displacements_m(3 * count_);
    for (std::size_t n = 0; n < displacements_m.size(); ++n)
      displacements_m[n] = moved->GetComponent(static_cast<vtkIdType>(n / 3), static_cast<int>(n % 3));
    return outermost_.upright_axis(displacements_m);
  }

 private:
  std::size_t count_;
  meshes::OutermostPoints outermost_;
};

/// The frames at the ends of strokes, the one before them all first.
std::vector<io::CollectionEntry> frames_at_ends(const fs::path& folder, double period_s) {
  std::vector<io::CollectionEntry> frames;
  for (io::CollectionEntry& entry : io::read_collection(folder / "frames.pvd"))
    if (entry.part == 0 && std::isfinite(entry.time_s) && is_within(folder / entry.file, folder))
      frames.push_back(std::move(entry));
  std::ranges::stable_sort(frames, {}, &io::CollectionEntry::time_s);
  if (frames.empty()) return {};
  std::vector<io::CollectionEntry> chosen{frames.front()};
  const double start_s = frames.front().time_s;
  const double end_s = frames.back().time_s;
  // Two frames in a stroke at least: fewer do not tell one stroke from the next.
  if (static_cast<double>(frames.size() - 1) * period_s < 2.0 * (end_s - start_s)) return {};
  constexpr double rounding = 1e-3;
  for (int n = 1; n * period_s <= end_s - start_s + rounding * period_s; ++n) {
    const double time_s = start_s + n * period_s;
    chosen.push_back(
        *std::ranges::min_element(frames, {}, [&](const io::CollectionEntry& entry) { return std::abs(entry.time_s - time_s); }));
  }
  return chosen;
}

std::optional<Fall> first_fall(const fs::path& folder, const std::vector<io::CollectionEntry>& frames) {
  const std::vector<Place> at_rest_m = points_of(*read_frame_grid(folder / frames.front().file));
  if (at_rest_m.empty()) throw io::InputError((folder / frames.front().file).string() + ": has no points");
  const Posture posture(at_rest_m);
  const Place first = posture.upright(folder / frames[1].file);
  for (std::size_t n = 2; n < frames.size(); ++n) {
    const Place now = posture.upright(folder / frames[n].file);
    const double lean_deg = meshes::angle_between_deg(first, now);
    if (lean_deg > largest_lean_deg) return Fall{.time_s = frames[n].time_s, .lean_deg = lean_deg};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Fall> fall_in_walk(const fs::path& folder, double period_s) {
  if (!io::is_file(folder / "frames.pvd")) return std::nullopt;
  const std::vector<io::CollectionEntry> frames = frames_at_ends(folder, period_s);
  constexpr std::size_t least_frames = 3;  // the first, and the ends of two strokes
  if (frames.size() < least_frames) return std::nullopt;
  const std::string told = io::read_in_child(folder / frames.front().file, "VTK", [&] {
    const std::optional<Fall> fall = first_fall(folder, frames);
    return fall ? two_numbers(fall->time_s, fall->lean_deg) : std::string();
  });
  if (told.empty()) return std::nullopt;
  const auto [time_s, lean_deg] = two_numbers_in(told);
  return Fall{.time_s = time_s, .lean_deg = lean_deg};
}

}  // namespace menger::evolution
