#include "io/picture/scale_bar.h"

#include <cmath>
#include <initializer_list>

namespace menger::io {

double scale_bar_length(double longest) {
  const double decade = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= longest) return factor * decade;
  }
  return decade;
}

}  // namespace menger::io
