#pragma once

#include <optional>
#include <variant>

namespace menger::fem {

inline constexpr double standard_atmosphere_Pa = 101325.0;

/// A closed amount of gas with P V^n = const, where the absolute pressure is P = p + p_ambient and p is the gauge pressure.
///
/// The reference state defines the gas: at the pressure p0 an amount a = 1 has the volume V0. An amount a of the same gas has the
/// volume a V0 there, so that P = (p0 + p_ambient) (a V0 / V)^n. For n = 1 P grows with a, otherwise with a^n.
struct GasLaw {
  double exponent = 1.0;                                ///< n > 0; 1: isothermal, heat capacity ratio (1.4, air): adiabatic
  double ambient_pressure_Pa = standard_atmosphere_Pa;  ///< absolute, >= 0
  double reference_pressure_Pa = 0.0;                   ///< p0, gauge; p0 + p_ambient > 0
  double reference_volume_m3 = 1.0;                     ///< V0 > 0
  double amount = 1.0;                                  ///< a > 0
};

/// Returns whether all parameters are in the range where the law is defined; the functions below assert it.
bool is_valid(const GasLaw& gas);

/// The volume W(p) of a gas, and its derivative.
struct GasVolume {
  double volume_m3;             ///< W > 0
  double derivative_m3_per_Pa;  ///< dW/dp < 0
};

/// Returns the volume that the gas has at the gauge pressure p, W = a V0 ((p0 + p_ambient) / (p + p_ambient))^(1/n); nothing if
/// the absolute pressure is not positive.
std::optional<GasVolume> gas_volume(const GasLaw& gas, double pressure_Pa);

/// Returns the gauge pressure, Pa, at a given volume, the inverse of gas_volume; nothing if the volume is not positive.
std::optional<double> gas_pressure_Pa(const GasLaw& gas, double volume_m3);

/// Returns the work, J, that the gas does on the walls minus the work on the surroundings: int p dV, with the gauge pressure p,
/// from one volume to another (both > 0, asserted). The energy that it stores is -int p dV. Near ambient pressure two large works
/// cancel.
double gas_work_J(const GasLaw& gas, double from_volume_m3, double to_volume_m3);

/// Control of a plenum by its pressure. PlenumControl lists all kinds of control.
struct PressureControl {
  double pressure_Pa = 0.0;  ///< gauge
};
struct VolumeControl {
  double volume_m3 = 0.0;  ///< of all chambers of the plenum
};
using PlenumControl = std::variant<PressureControl, VolumeControl, GasLaw>;

/// The residual and derivatives of the equation c(p, V) = 0 that closes a plenum. V is the volume of its chambers.
struct PlenumClosure {
  double residual;     ///< p - p_given (Pa), V - V_given (m^3) or V - W(p) (m^3)
  double by_pressure;  ///< dc/dp; dc/dV is 0 where the pressure is given, else 1
};

/// Returns the closure at a state; nothing if the gas has no volume at that pressure.
///
/// In the bordered system K du - V_u dp = -r, c_V V_u . du + c_p dp = -c. Control by pressure has c_V = 0, because p is known.
/// The other two have c_V = 1, so that the second row times -1 makes the system symmetric.
std::optional<PlenumClosure> plenum_closure(const PlenumControl& control, double pressure_Pa, double volume_m3);

}  // namespace menger::fem
