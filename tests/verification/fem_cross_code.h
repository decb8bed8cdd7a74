#pragma once

#include <string>

#include "fem_hollow_cube.h"

namespace menger::fem {

/// What other codes give for the hollow cube of edge 20 mm and wall 2 mm at 6 kPa. Two independent codes agree on the
/// displacement elements to all digits; the others come from one.
struct PublishedCube {
  std::string name;
  int degree;
  Formulation formulation;
  std::size_t elements_through_wall;
  double top_mm;
  double side_mm;
  double volume_percent;  ///< added to the chamber's
  double energy_J;        ///< of the whole cube
};

/// Computes a quarter of it and expects the numbers to 1e-4, somewhat more than the last digit of the shortest.
void expect_published(const PublishedCube& published);

}  // namespace menger::fem
