#include "fem/walk/walk_result.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "meshes/load_cases/observables.h"

namespace menger::fem {

std::optional<Travel> travel_of(const WalkResult& result) {
  if (result.status != io::RunStatus::completed || result.records.empty()) return std::nullopt;
  Travel travel;
  travel.displacement_m = difference(result.records.back().centre_of_mass_m, result.records.front().centre_of_mass_m);
  travel.horizontal_displacement_m = meshes::horizontal_displacement(travel.displacement_m);
  travel.horizontal_displacement_body_lengths = travel.horizontal_displacement_m / result.body_length_m;
  const double duration_s = result.records.back().time_s - result.records.front().time_s;
  travel.body_lengths_per_minute = 60.0 * travel.horizontal_displacement_body_lengths / duration_s;
  if (travel.horizontal_displacement_m > 0.0)
    travel.direction_deg = 180.0 / std::numbers::pi * std::atan2(travel.displacement_m[1], travel.displacement_m[0]);
  return travel;
}

double peak_height_m(const WalkResult& result) {
  double highest = result.records.front().centre_of_mass_m[2];
  for (const WalkRecord& record : result.records) highest = std::max(highest, record.centre_of_mass_m[2]);
  return highest - result.ground_height_m;
}

Point centre_of_mass_at(const WalkResult& result, double time_s) {
  assert(!result.records.empty());
  const auto after = std::ranges::upper_bound(result.records, time_s, {}, &WalkRecord::time_s);
  if (after == result.records.begin()) return after->centre_of_mass_m;
  const WalkRecord& before = *(after - 1);
  if (after == result.records.end()) return before.centre_of_mass_m;
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  return sum(before.centre_of_mass_m, scaled(share, difference(after->centre_of_mass_m, before.centre_of_mass_m)));
}

namespace {

std::size_t count_of_periods(const WalkResult& result, double period_s) {
  constexpr double rounding = 1e-9;  // of a count of periods
  if (result.records.empty()) return 0;
  return static_cast<std::size_t>((result.records.back().time_s - result.records.front().time_s) / period_s + rounding);
}

/// Returns the record next to a time.
const WalkRecord& record_near(const WalkResult& result, double time_s) {
  return *std::ranges::min_element(result.records, {},
                                   [&](const WalkRecord& record) { return std::abs(record.time_s - time_s); });
}

}  // namespace

meshes::Lean largest_lean(const WalkResult& result, double period_s) {
  std::vector<Point> upright_axes;
  const std::size_t count = count_of_periods(result, period_s);
  for (std::size_t n = 1; n <= count; ++n)
    upright_axes.push_back(record_near(result, result.records.front().time_s + static_cast<double>(n) * period_s).upright);
  return meshes::largest_lean(upright_axes);
}

std::vector<Point> period_displacements_m(const WalkResult& result, double period_s) {
  const std::size_t count = count_of_periods(result, period_s);
  if (count == 0) return {};
  const double start_s = result.records.front().time_s;
  std::vector<Point> displacements;
  Point before = result.records.front().centre_of_mass_m;
  for (std::size_t n = 1; n <= count; ++n) {
    const Point now = centre_of_mass_at(result, start_s + static_cast<double>(n) * period_s);
    displacements.push_back(difference(now, before));
    before = now;
  }
  return displacements;
}

}  // namespace menger::fem
