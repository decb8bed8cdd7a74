#include "fem/pneumatics/pneumatic_piston.h"

#include <cmath>
#include <numbers>

namespace menger::fem {

using std::numbers::pi;

namespace {

double area_m2(const Piston& piston) { return 0.25 * pi * piston.bore_m * piston.bore_m; }

/// The angle of the crank, from 0 to 2 pi.
double angle(const Piston& piston, double time_s) {
  const double periods = piston.frequency_Hz * time_s + piston.phase;
  return 2.0 * pi * (periods - std::floor(periods));
}

}  // namespace

double swept_volume_m3(const Piston& piston) { return area_m2(piston) * piston.stroke_m; }

double cylinder_volume_m3(const Piston& piston, double time_s) {
  const double ramp = time_s < piston.ramp_s ? time_s / piston.ramp_s : 1.0;
  const double path_m = ramp * 0.5 * piston.stroke_m * (1.0 - std::cos(angle(piston, time_s)));
  return piston.dead_volume_m3 + area_m2(piston) * (piston.cylinder_length_m - path_m);
}

double cylinder_rate_m3_per_s(const Piston& piston, double time_s) {
  const bool is_ramp = time_s < piston.ramp_s;
  const double turn = angle(piston, time_s);
  double speed = (is_ramp ? time_s / piston.ramp_s : 1.0) * 2.0 * pi * piston.frequency_Hz * std::sin(turn);
  if (is_ramp) speed += (1.0 - std::cos(turn)) / piston.ramp_s;
  return -area_m2(piston) * 0.5 * piston.stroke_m * speed;
}

}  // namespace menger::fem
