#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace menger::io {

/// Returns what std::snprintf writes, whole and however long, for people. For numbers in files use number_text, which loses no
/// digits.
/// @param values a value for each conversion of the format, of its type
template <class... Values>
std::string formatted(const char* format, Values... values) {
  const int length = std::snprintf(nullptr, 0, format, values...);
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  std::snprintf(text.data(), text.size(), format, values...);
  text.pop_back();  // the null that ends it
  return text;
}

/// Returns a number in a few significant digits, for people, without trailing zeros (%.4g).
std::string shown(double value, int digits = 4);

/// Returns a number with what is counted, for people: "1 chamber", "3 bodies".
/// @param many the word for several; empty: that for one with an s
std::string counted(std::size_t number, std::string_view one, std::string_view many = "");

/// Returns a number padded with leading zeros to `digits` digits, so that file names sort in order.
std::string padded(std::size_t number, std::size_t digits);

/// Makes a name fit for use in the name of a column: replaces every character that is neither letter nor digit by "_".
std::string column_part(std::string name);

}  // namespace menger::io
