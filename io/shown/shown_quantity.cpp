#include "io/shown/shown_quantity.h"

#include <cmath>

#include "io/text/formatted.h"

namespace menger::io {

std::string kilopascals(double pressure_Pa, int digits) { return shown(1e-3 * pressure_Pa, digits) + " kPa"; }

std::string millimetres(double length_m, int digits) { return shown(1e3 * length_m, digits) + " mm"; }

std::string percents(double fraction) {
  const double percent = 100.0 * fraction;
  return formatted(std::abs(percent) < 9.95 ? "%.2g %%" : "%.0f %%", percent);
}

std::string body_lengths(double number) {
  const std::string text = shown(number, 2);
  return text + (text == "1" ? " body length" : " body lengths");
}

}  // namespace menger::io
