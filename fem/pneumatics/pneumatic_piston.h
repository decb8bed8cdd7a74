#pragma once

#include <string>

namespace menger::fem {

/// A piston on a crank or cam that moves as a cosine and pushes a closed amount of air through lines.
///
/// Its displacement into the cylinder is x = r stroke (1 - cos(2 pi (f t + phase))) / 2, with r = t / ramp up to the time `ramp`
/// and 1 after it. At phase 0 and at the start of a ramp it is fully withdrawn. The motor is strong: pressure does not slow it
/// down.
struct Piston {
  std::string name{};
  double bore_m = 0.0;             ///< > 0, diameter of the cylinder
  double cylinder_length_m = 0.0;  ///< > 0, length of the air in front of the withdrawn piston
  double stroke_m = 0.0;           ///< in (0, cylinder length]
  double dead_volume_m3 = 0.0;     ///< >= 0, of ports and fittings
  double frequency_Hz = 1.0;       ///< > 0
  double phase = 0.0;              ///< fraction of a period
  /// >= 0. With a ramp, pistons out of phase also start withdrawn.
  double ramp_s = 0.0;
  /// Gauge pressure in cylinder, lines and plena at the start, when the air is closed in.
  double fill_pressure_Pa = 0.0;
};

/// Returns the volume that a stroke displaces, pi/4 bore^2 stroke, m^3.
double swept_volume_m3(const Piston& piston);

/// Returns the volume of the air in cylinder and dead volume at a time, m^3.
double cylinder_volume_m3(const Piston& piston, double time_s);

/// Returns the rate of the cylinder's volume, m^3/s; at the end of the ramp it is the rate after the ramp.
double cylinder_rate_m3_per_s(const Piston& piston, double time_s);

}  // namespace menger::fem
