#include "fem/pneumatics/pneumatic_gas.h"

#include <cassert>
#include <cmath>

namespace menger::fem {

GasLaw gas_law(const PneumaticGas& gas, double free_air_m3) {
  return {.exponent = gas.exponent, .ambient_pressure_Pa = gas.ambient_pressure_Pa, .reference_volume_m3 = free_air_m3};
}

double free_air_m3(const PneumaticGas& gas, double pressure_Pa, double volume_m3) {
  assert(pressure_Pa > -gas.ambient_pressure_Pa && volume_m3 > 0.0);
  return volume_m3 * std::exp(std::log1p(pressure_Pa / gas.ambient_pressure_Pa) / gas.exponent);
}

double air_pressure_Pa(const PneumaticGas& gas, double free_air_m3, double volume_m3) {
  return *gas_pressure_Pa(gas_law(gas, free_air_m3), volume_m3);
}

double air_energy_J(const PneumaticGas& gas, double free_air_m3, double volume_m3) {
  return -gas_work_J(gas_law(gas, free_air_m3), free_air_m3, volume_m3);
}

double flow_energy_J_per_m3(const PneumaticGas& gas, double pressure_Pa) {
  assert(pressure_Pa > -gas.ambient_pressure_Pa);
  const double logarithm = std::log1p(pressure_Pa / gas.ambient_pressure_Pa);
  const double rest = 1.0 - 1.0 / gas.exponent;
  return gas.ambient_pressure_Pa * (rest == 0.0 ? logarithm : std::expm1(rest * logarithm) / rest);
}

}  // namespace menger::fem
