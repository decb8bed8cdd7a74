#include "voxel/model/law_extremes.h"

#include <algorithm>
#include <boost/math/tools/polynomial.hpp>
#include <cstddef>

namespace menger::voxel {
namespace {

using Polynomial = boost::math::tools::polynomial<double>;  // coefficients of rising powers

/// Returns where a polynomial changes its sign between 0 and 1. It is monotone between the roots of its derivative.
std::vector<double> sign_changes(const Polynomial& p) {
  if (p.size() < 2) return {};
  std::vector<double> ends = sign_changes(p.prime());
  ends.insert(ends.begin(), 0.0);
  ends.push_back(1.0);
  std::vector<double> roots;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    double below = ends[i];
    double above = ends[i + 1];
    const bool starts_positive = p(below) > 0.0;
    if (starts_positive == (p(above) > 0.0)) continue;
    for (;;) {
      const double middle = 0.5 * (below + above);
      if (!(below < middle && middle < above)) break;
      ((p(middle) > 0.0) == starts_positive ? below : above) = middle;
    }
    roots.push_back(above);
  }
  return roots;
}

}  // namespace

std::vector<double> extreme_pressures(const PressureLaw& law, double lowest_Pa, double highest_Pa) {
  std::vector<double> pressures{lowest_Pa, highest_Pa};
  if (!(highest_Pa > 0.0) || !(law.slope_per_Pa * law.arc * law.arc_per_Pa < 0.0)) return pressures;
  // With t the pressure by the highest one, the slope is
  //   a (w / (1 + k t)^2 + (1 - w) / (1 - q t)^2) + 2 d h^2 t / (1 + (h t)^2)^2,
  // and a polynomial once it is multiplied by all its denominators, which are positive. Products of larger numbers overflow, and
  // what fades or bends earlier than that has done so at once.
  constexpr double at_once = 1e30;
  const double share = law.fading_share;
  const double fading = share > 0.0 ? std::min(law.fading_per_Pa * highest_Pa, at_once) : 0.0;
  const double softening = share < 1.0 ? std::max(law.pressure_softening_per_Pa * highest_Pa, -at_once) : 0.0;
  const double bend = std::min(law.arc_per_Pa * highest_Pa, at_once);
  const auto squared = [](const Polynomial& p) { return p * p; };
  const Polynomial faded = squared({{1.0, fading}});
  const Polynomial softened = squared({{1.0, -softening}});
  const Polynomial bent = squared({{1.0, 0.0, bend * bend}});
  const double stretch = law.slope_per_Pa * highest_Pa;
  const Polynomial stretches = stretch * share * softened + stretch * (1.0 - share) * faded;
  const Polynomial draws_in = Polynomial{{0.0, 2.0 * law.arc * bend * bend}} * faded * softened;
  const Polynomial slope = stretches * bent + draws_in;
  for (const double t : sign_changes(slope)) {
    const double pressure_Pa = t * highest_Pa;
    if (pressure_Pa > lowest_Pa && pressure_Pa < highest_Pa) pressures.push_back(pressure_Pa);
  }
  return pressures;
}

}  // namespace menger::voxel
