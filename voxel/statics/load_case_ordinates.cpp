#include "voxel/statics/load_case_ordinates.h"

#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "voxel/statics/body_shape.h"
#include "voxel/statics/vibration.h"

namespace menger::voxel {
namespace {

using meshes::LoadCaseKind;
using meshes::Side;

double force_on(LoadCaseKind kind, const Equilibrium& equilibrium) {
  if (kind == LoadCaseKind::press) return equilibrium.ground_force_N();
  const PlateLoad load = equilibrium.plate_load(1);
  return kind == LoadCaseKind::shear ? load.force.z : load.force.x;
}

double moment_on(LoadCaseKind kind, const Equilibrium& equilibrium) {
  const PlateLoad load = equilibrium.plate_load(1);
  return kind == LoadCaseKind::torsion ? load.moment.x : load.moment.y;
}

/// Extents and height of the top. Those of a free body are in its own frame.
BodyShape::FreeSize size_of(const BodyShape& shape, LoadCaseKind kind) {
  if (kind == LoadCaseKind::inflation) return shape.free_size();
  return {.extents = {shape.extent(0), shape.extent(1), shape.extent(2)}, .top_height = shape.top_height()};
}

double tip_height_at_rest(const StaticBody& body) {
  double sum = 0.0;
  const std::vector<std::size_t> tip = body.end_voxels(Side::x_max);
  for (const std::size_t voxel : tip) sum += body.rest[voxel].position.z;
  return sum / static_cast<double>(tip.size());
}

/// Returns the position of a foot among the feet of a body, from the name of its column; nothing for other columns.
std::optional<std::size_t> foot_of(std::string_view column) {
  constexpr std::string_view before = "foot_";
  constexpr std::string_view after = "_out_m";
  if (!column.starts_with(before) || !column.ends_with(after)) return std::nullopt;
  column.remove_prefix(before.size());
  column.remove_suffix(after.size());
  std::size_t number = 0;
  std::from_chars(column.data(), column.data() + column.size(), number);
  return number - 1;
}

/// One number of a row, other than a frequency, by the name of its column. @param size of the shape, see size_of
double observed(const std::string& column, LoadCaseKind kind, const Equilibrium& equilibrium, const BodyShape& shape,
                const BodyShape::FreeSize& size) {
  const StaticBody& body = equilibrium.balance().body();
  if (column == "force_N") return force_on(kind, equilibrium);
  if (column == "moment_N_m") return moment_on(kind, equilibrium);
  if (column == "volume_change") return shape.chamber_volume_change();
  if (column == "extent_x_m") return size.extents[0] - body.box_m[0];
  if (column == "extent_y_m") return size.extents[1] - body.box_m[1];
  if (column == "extent_z_m") return size.extents[2] - body.box_m[2];
  if (column == "top_m") return size.top_height - body.box_m[2];
  if (const auto foot = foot_of(column)) return shape.feet_outwards().at(*foot);
  if (column == "tip_m") return shape.tip_height() - tip_height_at_rest(body);
  throw std::logic_error("the surrogate does not have the column " + column);
}

}  // namespace

std::vector<double> load_case_ordinates(const std::vector<std::string>& columns, LoadCaseKind kind,
                                        const Equilibrium& equilibrium) {
  const std::size_t first = meshes::abscissa_count(kind);
  const std::size_t count = columns.size() - first;
  if (kind == LoadCaseKind::modes) {
    const Vibrations vibrations = natural_vibrations(small_motion(equilibrium), count);
    const bool all_there = vibrations.unstable_count == 0 && vibrations.frequencies_Hz.size() == count;
    return all_there ? vibrations.frequencies_Hz : std::vector<double>{};
  }
  std::vector<double> row;
  const BodyShape shape(equilibrium);
  const BodyShape::FreeSize size = size_of(shape, kind);
  for (std::size_t i = first; i < columns.size(); ++i) row.push_back(observed(columns[i], kind, equilibrium, shape, size));
  return row;
}

}  // namespace menger::voxel
