#pragma once

#include <string>

namespace menger::evolution {

/// Returns a pressure as robot.toml has it, in three digits, not further from 0: "4870 Pa", "-427 Pa".
std::string pressure_of_key(double pressure_Pa);

}  // namespace menger::evolution
