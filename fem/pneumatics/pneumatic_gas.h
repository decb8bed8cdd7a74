#pragma once

#include "fem/surfaces/gas_law.h"

namespace menger::fem {

/// Air in a pneumatic supply: its density follows from its pressure alone, P / P_ambient = (N / V)^n with the absolute pressure
/// P.
///
/// N is the free air in a volume V, m^3: the volume that it would take at ambient pressure. It stands for the mass, and lines
/// carry it from one volume to another. With n = 1 all air is as warm as the surroundings; with n = 1.4 air that is compressed
/// keeps its heat, and that of the same pressure is equally warm everywhere.
struct PneumaticGas {
  double exponent = 1.0;                                ///< n > 0
  double ambient_pressure_Pa = standard_atmosphere_Pa;  ///< absolute, > 0
};

/// The gas law of an amount of free air (> 0): P V^n = P_ambient N^n.
GasLaw gas_law(const PneumaticGas& gas, double free_air_m3);

/// Free air in a volume at a gauge pressure: N = V (1 + p / P_ambient)^(1/n), m^3. The absolute pressure must be positive
/// (asserts).
double free_air_m3(const PneumaticGas& gas, double pressure_Pa, double volume_m3);

/// Gauge pressure of free air in a volume, Pa; both positive (asserts).
double air_pressure_Pa(const PneumaticGas& gas, double free_air_m3, double volume_m3);

/// Work, J, that free air in a volume can do against the surroundings: E(N, V) >= 0, zero at ambient pressure; dE/dV = -p.
double air_energy_J(const PneumaticGas& gas, double free_air_m3, double volume_m3);

/// What a cubic metre of free air carries along when it flows out of a pressure: h = dE/dN = int dP V/N from ambient pressure, J
/// per m^3 of free air. Air that flows through a line loses the difference of its ends.
double flow_energy_J_per_m3(const PneumaticGas& gas, double pressure_Pa);

}  // namespace menger::fem
