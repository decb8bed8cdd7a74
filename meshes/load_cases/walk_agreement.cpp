#include "meshes/load_cases/walk_agreement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/text/formatted.h"

namespace menger::meshes {

double direction_deg(double x_m, double y_m) { return std::atan2(y_m, x_m) * 180.0 / std::numbers::pi; }

double angle_between_directions_deg(double a_deg, double b_deg) {
  const double turned = std::fmod(std::abs(a_deg - b_deg), 360.0);
  return std::min(turned, 360.0 - turned);
}

bool last_as_long(double a_s, double b_s) {
  constexpr double largest_share = 0.01;
  return std::abs(a_s - b_s) <= largest_share * std::max(a_s, b_s);
}

std::string moved_text(const std::string& name, double time_s, double x_m, double y_m) {
  const auto hundredths_mm = [](double length_m) {
    return io::formatted("%.2f", std::round(1e5 * length_m) / 1e2 + 0.0);  // no "-0.00"
  };
  return name + " after " + io::shown(time_s, 3) + " s: its centre moved by x = " + hundredths_mm(x_m) +
         " mm, y = " + hundredths_mm(y_m) + " mm";
}

WalkAgreement compare_walks(const WalkOutcome& a, const WalkOutcome& b) {
  const bool a_stays = a.body_lengths < walk_limits::least_body_lengths;
  const bool b_stays = b.body_lengths < walk_limits::least_body_lengths;
  if (a_stays && b_stays) return WalkAgreement::both_go_nowhere;
  if (a_stays || b_stays) return WalkAgreement::one_goes_nowhere;
  if (a.direction_deg && b.direction_deg &&
      angle_between_directions_deg(*a.direction_deg, *b.direction_deg) > walk_limits::same_direction_deg)
    return WalkAgreement::different;
  const double ratio = a.body_lengths / a.time_s / (b.body_lengths / b.time_s);
  const double times = std::max(ratio, 1.0 / ratio);
  if (times > walk_limits::comparable_speed) return WalkAgreement::different;
  return times <= walk_limits::same_speed ? WalkAgreement::alike : WalkAgreement::same_direction;
}

}  // namespace menger::meshes
