#include "io/text/range.h"

#include <cmath>

#include "io/text/number_text.h"

namespace menger::io {

bool Range::contains(double value) const {
  const bool above = lowest_excluded ? value > lowest : value >= lowest;
  const bool below = highest_excluded ? value < highest : value <= highest;
  return above && below;
}

std::string Range::demand() const {
  const bool bounded_below = std::isfinite(lowest);
  const bool bounded_above = std::isfinite(highest);
  if (bounded_below && bounded_above) {
    return "must be in " + std::string(lowest_excluded ? "(" : "[") + number_text(lowest) + ", " + number_text(highest) +
           (highest_excluded ? ")" : "]");
  }
  if (bounded_below) return std::string("must be ") + (lowest_excluded ? "> " : ">= ") + number_text(lowest);
  if (bounded_above) return std::string("must be ") + (highest_excluded ? "< " : "<= ") + number_text(highest);
  return {};
}

}  // namespace menger::io
