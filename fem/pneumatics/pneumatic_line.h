#pragma once

#include <optional>

#include "fem/pneumatics/pneumatic_gas.h"

namespace menger::fem {

/// Dynamic viscosity of dry air at 20 degrees Celsius, Pa s, and its density at standard pressure, kg/m^3.
/// @cite lemmon2004viscosity
inline constexpr double air_viscosity_Pa_s = 1.82e-5;
inline constexpr double air_density_kg_per_m3 = 1.204;

/// The bore of a smooth round tube.
struct RoundBore {
  double diameter_m = 0.0;                     ///< > 0
  double viscosity_Pa_s = air_viscosity_Pa_s;  ///< > 0
};

/// A tube between a supply and a plenum, described by resistance and volume. Half of the volume lies at either end.
///
/// Laminar flow follows Hagen and Poiseuille, in air of ambient temperature. Along the tube rho dP = -R rho_ambient dN/dt, hence
/// R dN/dt = (P1^2 - P2^2) / (2 P_ambient) =: D, with the free air N (see PneumaticGas). For small pressures dN/dt = (p1 - p2) /
/// R. In a bore of known diameter the flow is turbulent where this gives the larger resistance. With Blasius's friction factor
/// 0.3164 Re^(-1/4) of smooth tubes, R dN/dt = D* (D / D*)^(4/7) for D above D*, the drive at which the Reynolds number is 1187.
/// Without a diameter the flow stays laminar.
///
/// Limits: real tubes stay laminar up to Re of 2000 to 2300. Between 1187 and there the law gives up to 1.6 times too much
/// resistance. Blasius's factor is valid up to 1e5. The model leaves out four effects: entrances (tubes shorter than 0.06 Re
/// diameters resist more); Mach numbers above about 0.3; sound in a tube (a quarter wave in 1 m: 86 Hz); and the inertia of air.
/// The pressure of inertia, rho l dv/dt, adds to that of friction, and exceeds it where the Womersley number d/2 sqrt(omega rho /
/// mu) is above about 3.
/// @cite blasius1913ahnlichkeitsgesetz
struct PneumaticLine {
  double resistance_Pa_s_per_m3 = 0.0;  ///< R >= 0 of laminar flow; 0: both ends have the same pressure, and there is no bore
  double volume_m3 = 0.0;               ///< >= 0
  std::optional<RoundBore> bore{};
};

/// Returns a round tube of a given length and bore: R = 128 mu l / (pi d^4). All arguments positive (asserts).
PneumaticLine round_line(double length_m, const RoundBore& bore);

/// Returns the round tube of a given length and resistance, both positive (asserts).
PneumaticLine round_line_of(double length_m, double resistance_Pa_s_per_m3);

/// Returns the drive of a flow, D = (P1^2 - P2^2) / (2 P_ambient) = (p1 - p2) (1 + (p1 + p2) / (2 P_ambient)), Pa.
double line_drive_Pa(const PneumaticGas& gas, double from_Pa, double to_Pa);

/// Returns D*, the drive above which the flow is turbulent, Pa; infinite without a bore.
double laminar_drive_Pa(const PneumaticGas& gas, const PneumaticLine& line);

/// The flow times the resistance, R dN/dt, as a function of D, and its derivative. The function is odd and increasing.
struct ResistedFlow {
  double flow_Pa;
  double by_drive;
};
ResistedFlow resisted_flow(double drive_Pa, double laminar_drive_Pa);

/// Returns the flow of free air dN/dt, m^3/s, in a line with resistance (asserts).
double line_flow_m3_per_s(const PneumaticGas& gas, const PneumaticLine& line, double from_Pa, double to_Pa);

/// Returns the Reynolds number of a flow of free air, 4 rho_ambient |dN/dt| / (pi d mu). It is the same all along the tube.
/// rho_ambient is in proportion to the ambient pressure.
double reynolds_number(const PneumaticGas& gas, double flow_m3_per_s, const RoundBore& bore);

}  // namespace menger::fem
