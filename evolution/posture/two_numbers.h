#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <limits>
#include <string>

#include "io/text/formatted.h"

namespace menger::evolution {

/// Two numbers as the text in which a child process tells them, with all digits.
inline std::string two_numbers(double first, double second) {
  return io::formatted("%.17g ", first) + io::formatted("%.17g", second);
}

/// The numbers of such a text; NaN where it has none.
inline std::array<double, 2> two_numbers_in(const std::string& text) {
  std::array<double, 2> numbers{};
  const std::size_t between = std::min(text.find(' '), text.size());
  const std::array<std::size_t, 3> edges{0, between, text.size()};
  for (std::size_t n = 0; n < 2; ++n) {
    numbers.at(n) = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(text.data() + edges.at(n) + (n == 1 && between < text.size() ? 1 : 0), text.data() + edges.at(n + 1),
                    numbers.at(n));
  }
  return numbers;
}

}  // namespace menger::evolution
