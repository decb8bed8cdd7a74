#include "fem/load_cases/pressure_range.h"

#include <algorithm>
#include <cmath>

#include "io/text/number_text.h"
#include "materials/laws/hyperelastic_law.h"

namespace menger::fem {
namespace {

/// Volume of the chambers over that at rest at which the search for a limit point ends without one.
constexpr double largest_volume_ratio = 40.0;

/// Steps in volume over that at rest: as long as Newton's method allows at moderate strain.
constexpr double first_volume_step = 0.05;
constexpr double largest_volume_step = 0.4;
constexpr double smallest_volume_step = 1e-3;

/// Steps in vacuum over the end of the search, which is the shear modulus or, for stiff bodies, absolute vacuum.
constexpr double first_vacuum_step = 0.02;
constexpr double largest_vacuum_step = 0.1;
constexpr double smallest_vacuum_step = 2e-4;

/// Follows the body under vacuum by pressure, so that buckling of walls is detected. The search ends at the last pressure, or
/// there.
PathReport follow_vacuum(LoadCaseBody& body, double last_pressure_Pa, const std::atomic<bool>* stop) {
  PathDrives drives = body.at_rest();
  drives.plena.front().values = {0.0, last_pressure_Pa};
  PathOptions options;
  options.first_step = first_vacuum_step;
  options.largest_step = largest_vacuum_step;
  options.smallest_step = smallest_vacuum_step;
  return follow_path(body.equilibrium(), drives, options, {}, stop);
}

/// Follows the body to larger volumes by volume, so that it passes a limit point.
PathReport follow_volume(LoadCaseBody& body, std::optional<double> largest_pressure_Pa, const std::atomic<bool>* stop) {
  PathDrives drives = body.at_rest();
  drives.plena.front() = {.kind = DriveKind::volume, .values = {1.0, largest_volume_ratio}};
  const double leg = largest_volume_ratio - 1.0;
  PathOptions options;
  options.first_step = first_volume_step / leg;
  options.largest_step = std::min(0.5, largest_volume_step / leg);
  options.smallest_step = smallest_volume_step / leg;
  options.ends_at = [&](const PathPoint& point, const std::vector<LimitPoint>& limit_points) {
    return !limit_points.empty() || (largest_pressure_Pa && point.pressures_Pa.front() >= *largest_pressure_Pa);
  };
  return follow_path(body.equilibrium(), drives, options, {}, stop);
}

void remove_repetitions(std::vector<double>& ascending) {
  ascending.erase(std::unique(ascending.begin(), ascending.end()), ascending.end());
}

void add(std::string& text, const std::string& part) { text += (text.empty() ? "" : "; ") + part; }

}  // namespace

PressureRange find_pressure_range(LoadCaseBody& body, std::optional<double> largest_pressure_Pa, const std::atomic<bool>* stop) {
  PressureRange range;
  const double modulus_Pa = materials::shear_modulus_at_rest_Pa(body.equilibrium().body().regions.front().law);
  const PathReport down = follow_vacuum(body, -std::min(modulus_Pa, standard_atmosphere_Pa), stop);
  if (!down.points.empty()) range.lowest_pressure_Pa = down.points.back().pressures_Pa.front();
  const std::string lowest = io::number_text(std::round(range.lowest_pressure_Pa)) + " Pa";
  if (down.status == io::RunStatus::wall_contact) {
    range.contact_pressure_Pa = range.lowest_pressure_Pa;
  } else if (down.status == io::RunStatus::limit_point) {
    add(range.reason, "under vacuum walls buckle at " + lowest + " before they touch");
  } else if (down.status == io::RunStatus::completed) {
    add(range.reason, "under vacuum walls do not touch down to " + lowest);
  } else {
    add(range.reason, "walls were not found to touch under vacuum down to " + lowest + ": " + down.reason);
  }
  range.stopped = down.status == io::RunStatus::stopped;
  if (range.stopped) return range;
  const PathReport up = follow_volume(body, largest_pressure_Pa, stop);
  for (const PathPoint& point : up.points) range.highest_pressure_Pa = std::max(range.highest_pressure_Pa, point.pressures_Pa[0]);
  if (!up.limit_points.empty()) {
    range.limit_pressure_Pa = up.limit_points.front().pressure_Pa;
  } else if (!largest_pressure_Pa || range.highest_pressure_Pa < *largest_pressure_Pa) {
    add(range.reason, "no limit point was found: " + up.reason);
  }
  if (largest_pressure_Pa) range.highest_pressure_Pa = std::min(range.highest_pressure_Pa, *largest_pressure_Pa);
  range.stopped = up.status == io::RunStatus::stopped;
  return range;
}

std::vector<double> pressures_between(double lowest_Pa, double highest_Pa, int count) {
  const int below = count / 3;
  const int above = count - 1 - below;
  std::vector<double> pressures_Pa;
  for (int n = below; n > 0; --n) pressures_Pa.push_back(lowest_Pa * n / below);
  pressures_Pa.push_back(0.0);
  for (int n = 1; n <= above; ++n) pressures_Pa.push_back(highest_Pa * n / above);
  remove_repetitions(pressures_Pa);
  return pressures_Pa;
}

std::vector<double> pressures_at(const std::vector<double>& fractions, double lowest_Pa, double highest_Pa) {
  std::vector<double> pressures_Pa;
  pressures_Pa.reserve(fractions.size());
  for (const double fraction : fractions) pressures_Pa.push_back(fraction < 0.0 ? -fraction * lowest_Pa : fraction * highest_Pa);
  remove_repetitions(pressures_Pa);
  return pressures_Pa;
}

}  // namespace menger::fem
