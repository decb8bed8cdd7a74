#include "fem/surfaces/gas_law.h"

#include <cassert>
#include <cmath>

namespace menger::fem {

bool is_valid(const GasLaw& gas) {
  return std::isfinite(gas.exponent) && gas.exponent > 0.0 && std::isfinite(gas.ambient_pressure_Pa) &&
         gas.ambient_pressure_Pa >= 0.0 && std::isfinite(gas.reference_pressure_Pa) &&
         gas.reference_pressure_Pa + gas.ambient_pressure_Pa > 0.0 && std::isfinite(gas.reference_volume_m3) &&
         gas.reference_volume_m3 > 0.0 && std::isfinite(gas.amount) && gas.amount > 0.0;
}

std::optional<GasVolume> gas_volume(const GasLaw& gas, double pressure_Pa) {
  assert(is_valid(gas));
  const double absolute_Pa = pressure_Pa + gas.ambient_pressure_Pa;
  if (!(absolute_Pa > 0.0)) return std::nullopt;
  const double reference_Pa = gas.reference_pressure_Pa + gas.ambient_pressure_Pa;
  const double volume = gas.amount * gas.reference_volume_m3 * std::pow(reference_Pa / absolute_Pa, 1.0 / gas.exponent);
  return GasVolume{.volume_m3 = volume, .derivative_m3_per_Pa = -volume / (gas.exponent * absolute_Pa)};
}

std::optional<double> gas_pressure_Pa(const GasLaw& gas, double volume_m3) {
  assert(is_valid(gas));
  if (!(volume_m3 > 0.0)) return std::nullopt;
  // (P - P0) / P0, from the difference of the volumes, so that a small gauge pressure keeps its digits beside the ambient one.
  const double filling = (gas.amount * gas.reference_volume_m3 - volume_m3) / volume_m3;
  const double growth = std::expm1(gas.exponent * std::log1p(filling));
  return gas.reference_pressure_Pa + (gas.reference_pressure_Pa + gas.ambient_pressure_Pa) * growth;
}

double gas_work_J(const GasLaw& gas, double from_volume_m3, double to_volume_m3) {
  assert(is_valid(gas) && from_volume_m3 > 0.0 && to_volume_m3 > 0.0);
  const double reference_Pa = gas.reference_pressure_Pa + gas.ambient_pressure_Pa;
  const double start_Pa = reference_Pa * std::pow(gas.amount * gas.reference_volume_m3 / from_volume_m3, gas.exponent);
  const double stretch = std::log(to_volume_m3 / from_volume_m3);
  const double rest = 1.0 - gas.exponent;
  // int_1^e^stretch v^-n dv, which for n -> 1 tends to the logarithm
  const double integral = rest == 0.0 ? stretch : std::expm1(rest * stretch) / rest;
  return start_Pa * from_volume_m3 * integral - gas.ambient_pressure_Pa * (to_volume_m3 - from_volume_m3);
}

std::optional<PlenumClosure> plenum_closure(const PlenumControl& control, double pressure_Pa, double volume_m3) {
  if (const auto* pressure = std::get_if<PressureControl>(&control))
    return PlenumClosure{.residual = pressure_Pa - pressure->pressure_Pa, .by_pressure = 1.0};
  if (const auto* volume = std::get_if<VolumeControl>(&control))
    return PlenumClosure{.residual = volume_m3 - volume->volume_m3, .by_pressure = 0.0};
  const std::optional<GasVolume> gas = gas_volume(std::get<GasLaw>(control), pressure_Pa);
  if (!gas) return std::nullopt;
  return PlenumClosure{.residual = volume_m3 - gas->volume_m3, .by_pressure = -gas->derivative_m3_per_Pa};
}

}  // namespace menger::fem
