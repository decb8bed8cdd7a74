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

/// A tube between a supply and a plenum, as resistance and volume. Half of the volume lies at either end.
///
/// Laminar flow is that of Hagen and Poiseuille in air of ambient temperature: rho dP = -R rho_ambient dN/dt along the tube,
/// hence R dN/dt = (P1^2 - P2^2) / (2 P_ambient) =: D, N being free air (see PneumaticGas); for small pressures dN/dt = (p1 - p2)
/// / R. In a bore of known diameter it turns turbulent where that resists more: by Blasius's friction factor 0.3164 Re^(-1/4) of
/// smooth tubes R dN/dt = D* (D / D*)^(4/7) beyond the D* at which the Reynolds number is 1187. Without a diameter it stays
/// laminar.
///
/// Real tubes stay laminar up to 2000 to 2300: between the two the law resists up to 1.6 times too much; Blasius's factor ends at
/// 1e5. Left out are entrances (tubes shorter than 0.06 Re diameters resist more), Mach numbers above about 0.3, sound in a tube
/// (a quarter wave in 1 m: 86 Hz), and the inertia of air: its pressure rho l dv/dt adds to that of friction, which it exceeds
/// where the Womersley number d/2 sqrt(omega rho / mu) is above about 3.
/// @cite blasius1913ahnlichkeitsgesetz
struct PneumaticLine {
  double resistance_Pa_s_per_m3 = 0.0;  ///< R >= 0 of laminar flow; 0: both ends have the same pressure, and there is no bore
  double volume_m3 = 0.0;               ///< >= 0
  std::optional<RoundBore> bore{};
};

/// A round tube: R = 128 mu l / (pi d^4). All arguments positive (asserts).
PneumaticLine round_line(double length_m, const RoundBore& bore);

/// The round tube of a length that has a resistance, both positive (asserts).
PneumaticLine round_line_of(double length_m, double resistance_Pa_s_per_m3);

/// D = (P1^2 - P2^2) / (2 P_ambient) = (p1 - p2) (1 + (p1 + p2) / (2 P_ambient)), Pa.
double line_drive_Pa(const PneumaticGas& gas, double from_Pa, double to_Pa);

/// D*, Pa, above which the flow is turbulent; infinite without a bore.
double laminar_drive_Pa(const PneumaticGas& gas, const PneumaticLine& line);

/// R dN/dt as function of D, odd and increasing, and its derivative.
struct ResistedFlow {
  double flow_Pa;
  double by_drive;
};
ResistedFlow resisted_flow(double drive_Pa, double laminar_drive_Pa);

/// Flow of free air dN/dt, m^3/s, in a line with resistance (asserts).
double line_flow_m3_per_s(const PneumaticGas& gas, const PneumaticLine& line, double from_Pa, double to_Pa);

/// Reynolds number of a flow of free air, 4 rho_ambient |dN/dt| / (pi d mu), the same all along the tube; rho_ambient is in
/// proportion to the ambient pressure.
double reynolds_number(const PneumaticGas& gas, double flow_m3_per_s, const RoundBore& bore);

}  // namespace menger::fem
