#include "voxel/validation/volume_actuation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "voxel/model/hollow_voxels.h"

namespace menger::voxel {

namespace {

/// Fraction of the outer volume of a body that is chambers.
double chamber_share(const meshes::LoadCase& load_case) {
  const auto& [nx, ny, nz] = load_case.cells;
  const HollowVoxels hollow =
      hollow_voxels(meshes::Polycube::from_digits(nx, ny, nz, load_case.digits),
                    {.cell_edge_m = load_case.cell_edge_m,
                     .wall_thickness_m = load_case.wall_thickness_m,
                     .level = load_case.level,
                     .chambers = load_case.per_phase ? meshes::ChamberLayout::per_phase : meshes::ChamberLayout::single});
  const double outer_m3 = static_cast<double>(hollow.wall_volume_m3.size()) * std::pow(load_case.cell_edge_m, 3);
  const double wall_m3 = std::accumulate(hollow.wall_volume_m3.begin(), hollow.wall_volume_m3.end(), 0.0);
  return 1.0 - wall_m3 / outer_m3;
}

/// A point of a curve: pressure and change of outer volume.
using Point = std::array<double, 2>;

/// Points in ascending order of pressure, with the state at rest.
std::vector<Point> points_of(const meshes::ResponseCurve& curve, double share) {
  std::vector<Point> points;
  const std::vector<double>& pressures = curve.column("pressure_Pa");
  const std::vector<double>& changes = curve.column("volume_change");
  for (std::size_t row = 0; row < pressures.size(); ++row) points.push_back({pressures[row], share * changes[row]});
  std::sort(points.begin(), points.end());
  const auto place =
      std::lower_bound(points.begin(), points.end(), Point{0.0, 0.0}, [](const Point& a, const Point& b) { return a[0] < b[0]; });
  if (place == points.end() || (*place)[0] > 0.0) points.insert(place, {0.0, 0.0});
  return points;
}

/// Value of coordinate `to` where coordinate `from` first reaches a value, along the points in their order; nothing if it never
/// does.
std::optional<double> crossing(const std::vector<Point>& points, double value, std::size_t from, std::size_t to) {
  if (points.front().at(from) == value) return points.front().at(to);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double before = points[i - 1].at(from);
    const double after = points[i].at(from);
    if ((before < value) == (after < value) && after != value) continue;
    const double part = (value - before) / (after - before);
    return points[i - 1].at(to) + part * (points[i].at(to) - points[i - 1].at(to));
  }
  return std::nullopt;
}

std::string signed_percent(double change) { return io::formatted("%+.3g %%", 100.0 * change); }

std::string swelling_sentence(const VolumeActuation& a, const ActuationAim& aim) {
  if (a.pressure_for_largest_Pa)
    return signed_percent(aim.largest_change) + " of the outer volume needs " + io::kilopascals(*a.pressure_for_largest_Pa);
  std::string text = signed_percent(aim.largest_change) +
                     " of the outer volume is not reached: " + signed_percent(a.change_at_highest) +
                     " at the end of the curve, at " + io::kilopascals(a.highest_pressure_Pa);
  if (a.limit_pressure_Pa)
    text += " (" + io::formatted("%.2g", a.highest_pressure_Pa / *a.limit_pressure_Pa) + " of the limit pressure)";
  return text;
}

std::string shrinking_sentence(const VolumeActuation& a, const ActuationAim& aim) {
  if (a.pressure_for_smallest_Pa)
    return signed_percent(aim.smallest_change) + " of the outer volume needs " + io::kilopascals(*a.pressure_for_smallest_Pa);
  if (a.lowest_pressure_Pa == 0.0) return "the curve contains no vacuum";
  std::string text = signed_percent(aim.smallest_change) +
                     " of the outer volume is not reached: " + signed_percent(a.change_at_lowest) +
                     " at the end of the curve, at " + io::kilopascals(a.lowest_pressure_Pa);
  if (a.contact_pressure_Pa) text += " (walls touch at " + io::kilopascals(*a.contact_pressure_Pa) + ")";
  return text;
}

}  // namespace

ActuationAim actuation_aim(double pressure_Pa, double amplitude) {
  return {.pressure_Pa = pressure_Pa,
          .largest_change = std::pow(1.0 + amplitude, 3) - 1.0,
          .smallest_change = std::pow(1.0 - amplitude, 3) - 1.0};
}

VolumeActuation volume_actuation(const meshes::ResponseCurve& curve, const std::string& body, const ActuationAim& aim) {
  assert(curve.provenance.load_case.kind == meshes::LoadCaseKind::inflation);
  VolumeActuation actuation{.body = body, .chamber_share = chamber_share(curve.provenance.load_case)};
  const std::vector<Point> points = points_of(curve, actuation.chamber_share);
  actuation.lowest_pressure_Pa = points.front()[0];
  actuation.change_at_lowest = points.front()[1];
  actuation.highest_pressure_Pa = points.back()[0];
  actuation.change_at_highest = points.back()[1];
  actuation.limit_pressure_Pa = curve.provenance.limit_pressure_Pa;
  actuation.contact_pressure_Pa = curve.provenance.contact_pressure_Pa;

  const auto rest = std::find_if(points.begin(), points.end(), [](const Point& point) { return point[0] == 0.0; });
  const std::vector<Point> pushed(rest, points.end());
  std::vector<Point> sucked(points.begin(), rest + 1);
  std::reverse(sucked.begin(), sucked.end());
  actuation.change_at_pressure = crossing(pushed, aim.pressure_Pa, 0, 1);
  actuation.pressure_for_largest_Pa = crossing(pushed, aim.largest_change, 1, 0);
  actuation.pressure_for_smallest_Pa = crossing(sucked, aim.smallest_change, 1, 0);
  return actuation;
}

std::vector<std::string> actuation_sentences(const VolumeActuation& actuation, const ActuationAim& aim) {
  std::string at_pressure;
  if (actuation.change_at_pressure) {
    at_pressure = io::kilopascals(aim.pressure_Pa) + " changes its outer volume by " +
                  signed_percent(*actuation.change_at_pressure) + ", " +
                  io::formatted("%.2g", *actuation.change_at_pressure / aim.largest_change) + " of the " +
                  signed_percent(aim.largest_change) + " of solid voxels";
  } else {
    at_pressure = io::kilopascals(aim.pressure_Pa) + " lies beyond the curve, which ends at " +
                  io::kilopascals(actuation.highest_pressure_Pa);
    if (actuation.limit_pressure_Pa) at_pressure += "; the limit pressure is " + io::kilopascals(*actuation.limit_pressure_Pa);
  }
  return {at_pressure, swelling_sentence(actuation, aim), shrinking_sentence(actuation, aim)};
}

}  // namespace menger::voxel
