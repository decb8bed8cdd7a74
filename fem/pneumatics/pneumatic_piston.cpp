#include "fem/pneumatics/pneumatic_piston.h"

#include <cmath>
#include <numbers>

namespace menger::fem {

using std::numbers::pi;

double swept_volume_m3(const Piston& piston) { return 0.25 * pi * piston.bore_m * piston.bore_m * piston.stroke_m; }

double cylinder_volume_m3(const Piston& piston, double time_s) {
  const double periods = piston.frequency_Hz * time_s + piston.phase;
  const double ramp = time_s < piston.ramp_s ? time_s / piston.ramp_s : 1.0;
  const double way_m = ramp * 0.5 * piston.stroke_m * (1.0 - std::cos(2.0 * pi * (periods - std::floor(periods))));
  return piston.dead_volume_m3 + 0.25 * pi * piston.bore_m * piston.bore_m * (piston.cylinder_length_m - way_m);
}

}  // namespace menger::fem
