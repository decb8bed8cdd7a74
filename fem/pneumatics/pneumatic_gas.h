#pragma once

#include "fem/surfaces/gas_law.h"

namespace menger::fem {

/// Air in a pneumatic supply. Its density depends on its pressure alone: P / P_ambient = (N / V)^n with the absolute pressure P.
///
/// N is the free air in a volume V, m^3: the volume that the air would take at ambient pressure. It stands for the mass, and
/// lines transport it from one volume to another. With n = 1 all air has the temperature of the surroundings. With n = 1.4
/// compressed air keeps its heat, and air of equal pressure is equally warm everywhere.
struct PneumaticGas {
  double exponent = 1.0;                                ///< n > 0
  double ambient_pressure_Pa = standard_atmosphere_Pa;  ///< absolute, > 0
};

/// Returns the gas law of an amount of free air (> 0): P V^n = P_ambient N^n.
GasLaw gas_law(const PneumaticGas& gas, double free_air_m3);

/// Returns the free air in a volume at a gauge pressure: N = V (1 + p / P_ambient)^(1/n), m^3. The absolute pressure must be
/// positive (asserts).
double free_air_m3(const PneumaticGas& gas, double pressure_Pa, double volume_m3);

/// Returns the gauge pressure of free air in a volume, Pa; both must be positive (asserts).
double air_pressure_Pa(const PneumaticGas& gas, double free_air_m3, double volume_m3);

/// Returns the work, J, that free air in a volume can do against the surroundings: E(N, V) >= 0, zero at ambient pressure; dE/dV
/// = -p.
double air_energy_J(const PneumaticGas& gas, double free_air_m3, double volume_m3);

/// Returns the energy that a cubic metre of free air carries when it flows out of a volume at a pressure: h = dE/dN = int dP V/N
/// from ambient pressure, J per m^3 of free air. Air that flows through a line loses the difference of h between its ends.
double flow_energy_J_per_m3(const PneumaticGas& gas, double pressure_Pa);

}  // namespace menger::fem
