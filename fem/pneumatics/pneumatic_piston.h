#pragma once

#include <string>

namespace menger::fem {

/// A piston on a crank or cam that moves as a cosine and pushes a closed amount of air through lines.
///
/// Its way into the cylinder is x = r stroke (1 - cos(2 pi (f t + phase))) / 2 with r = t / ramp up to the time ramp and 1 from
/// there on; at phase 0 and at the start of a ramp it stands withdrawn. The motor is strong: pressure does not slow it down.
struct Piston {
  std::string name{};
  double bore_m = 0.0;             ///< > 0, diameter of the cylinder
  double cylinder_length_m = 0.0;  ///< > 0, of the air before the withdrawn piston
  double stroke_m = 0.0;           ///< in (0, cylinder length]
  double dead_volume_m3 = 0.0;     ///< >= 0, of ports and fittings
  double frequency_Hz = 1.0;       ///< > 0
  double phase = 0.0;              ///< fraction of a period
  double ramp_s = 0.0;             ///< >= 0; pistons out of phase begin withdrawn with one
  double fill_pressure_Pa = 0.0;   ///< gauge pressure in cylinder, lines and plena when the air is closed in, at the start
};

/// Volume that a stroke displaces, pi/4 bore^2 stroke, m^3.
double swept_volume_m3(const Piston& piston);

/// Volume of the air in cylinder and dead volume at a time, m^3.
double cylinder_volume_m3(const Piston& piston, double time_s);

/// Its rate, m^3/s; at the end of the ramp that of later.
double cylinder_rate_m3_per_s(const Piston& piston, double time_s);

}  // namespace menger::fem
