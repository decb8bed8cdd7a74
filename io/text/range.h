#pragma once

#include <limits>
#include <string>

namespace menger::io {

/// The interval that a number read from outside must lie in.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_excluded = false;
  bool highest_excluded = false;

  [[nodiscard]] bool contains(double value) const;

  /// Returns the condition in words: "must be > 0", "must be in [0, 1]"; empty if every number is allowed.
  [[nodiscard]] std::string demand() const;
};

inline Range any_number() { return {}; }
inline Range positive() { return {.lowest = 0.0, .lowest_excluded = true}; }
inline Range non_negative() { return {.lowest = 0.0}; }
inline Range at_least(double lowest) { return {.lowest = lowest}; }
inline Range at_most(double highest) { return {.highest = highest}; }
inline Range within(double lowest, double highest) { return {.lowest = lowest, .highest = highest}; }  ///< ends included
inline Range between(double lowest, double highest) {                                                  ///< ends excluded
  return {.lowest = lowest, .highest = highest, .lowest_excluded = true, .highest_excluded = true};
}

}  // namespace menger::io
