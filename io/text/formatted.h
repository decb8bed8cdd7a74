#pragma once

#include <string>

namespace menger::io {

/// A number as std::snprintf writes it, for people; files take number_text, which loses nothing.
/// @param format with one conversion of a double
std::string formatted(const char* format, double value);

}  // namespace menger::io
