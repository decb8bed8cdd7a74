#include "io/study/magnitude.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/study/key_text.h"
#include "io/text/number_text.h"

namespace menger::io {
namespace {

/// Magnitudes between which numbers of a unit must lie. The least one is only for numbers that must be positive; others may be as
/// small as they like.
struct Magnitudes {
  std::string_view unit;
  double least;
  double most;
};

/// Bounds far beyond all bodies and drives that the models bear. Numbers outside of them are slips of the pen, whose products and
/// quotients leave the range of floating-point numbers. Times have no upper one: the number of steps bounds them.
constexpr std::array<Magnitudes, 18> magnitudes{{{"m", 1e-9, 1e6},
                                                 {"m2", 1e-18, 1e12},
                                                 {"m3", 1e-21, 1e12},
                                                 {"s", 1e-12, std::numeric_limits<double>::max()},
                                                 {"Hz", 1e-9, 1e9},
                                                 {"Pa", 1e-6, 1e30},
                                                 {"kg/m3", 1e-9, 1e9},
                                                 {"kg", 1e-21, 1e12},
                                                 {"N", 1e-21, 1e15},
                                                 {"N/m", 1e-12, 1e15},
                                                 {"Pa/m", 1e-6, 1e36},
                                                 {"m/s", 1e-15, 1e9},
                                                 {"m/s2", 1e-12, 1e9},
                                                 {"Pa s", 1e-12, 1e9},
                                                 {"Pa s/m3", 1e-6, 1e21},
                                                 {"1/Pa", 0.0, 1e9},
                                                 {"rad", 0.0, 1e9},
                                                 {"", 0.0, 1e18}}};

}  // namespace

std::string fault_of_magnitude(const StudyEntry& entry, double value) {
  const std::string unit = unit_of(entry.key.name);
  const auto* const found = std::ranges::find(magnitudes, std::string_view(unit), &Magnitudes::unit);
  if (found == magnitudes.end() || value == 0.0) return "";
  const std::string in_unit = unit.empty() ? "" : " " + unit;
  if (std::abs(value) > found->most)
    return "must be at most " + number_text(found->most) + in_unit + " in magnitude: no model bears more";
  if (entry.range.lowest >= 0.0 && value < found->least)
    return "must be at least " + number_text(found->least) + in_unit + (entry.range.lowest_excluded ? "" : " or 0") +
           ": no model bears less";
  return "";
}

}  // namespace menger::io
