#pragma once

#include <string>

namespace menger::evolution {

/// Returns a pressure in three digits, not further from 0: what is safe must not be rounded to what is not.
double rounded_to_rest_Pa(double pressure_Pa);

/// Returns a pressure as robot.toml has it, rounded so: "4870 Pa", "-427 Pa".
std::string pressure_of_key(double pressure_Pa);

}  // namespace menger::evolution
