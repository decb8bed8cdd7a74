#pragma once

#include <cstddef>
#include <string>

namespace menger::io {

/// A number as std::snprintf writes it, for people; files take number_text, which loses nothing.
/// @param format with one conversion of a double
std::string formatted(const char* format, double value);

/// A number for people in a few significant digits, without zeros behind them (%.4g).
std::string shown(double value, int digits = 4);

/// A number with zeros before it up to so many digits, for names of files that stand in order.
std::string padded(std::size_t number, std::size_t digits);

/// A name as part of the name of a column: whatever is neither letter nor digit becomes "_".
std::string column_part(std::string name);

}  // namespace menger::io
