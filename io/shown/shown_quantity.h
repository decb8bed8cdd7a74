#pragma once

#include <string>

namespace menger::io {

// Quantities with their units, for people. Files have SI and all digits.

/// "3.04 kPa". @param digits significant ones
std::string kilopascals(double pressure_Pa, int digits = 3);

/// Returns a pressure in three significant digits, not further from 0: what is safe must not be rounded to what is not.
double rounded_towards_rest(double pressure_Pa);

/// A pressure as files state it, rounded so: "4870 Pa", "-427 Pa".
std::string pascals_towards_rest(double pressure_Pa);

/// "12.5 mm"; less than 1e-8 m is told as 0. @param digits significant ones
std::string millimetres(double length_m, int digits = 3);

/// "6.6 %", "127 %": two significant digits, and all of those before the point.
std::string percents(double fraction);

/// "3 degrees", "1 degree": in whole ones.
std::string degrees(double angle_deg);

/// "0.32 body lengths", "1 body length": two significant digits; less than 1e-4 is told as 0.
std::string body_lengths(double number);

}  // namespace menger::io
