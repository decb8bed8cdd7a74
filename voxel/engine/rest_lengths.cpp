#include "voxel/engine/rest_lengths.h"

#include <algorithm>
#include <cmath>

namespace menger::voxel {

template <class Real>
LateralCoupling<Real>::LateralCoupling(const Lattice& lattice, double coupling, const std::array<std::vector<double>, 3>& axial_N)
    : half_coupling_(static_cast<Real>(0.5 * coupling)), sums_(lattice.voxel_count()) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice.beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      beams_[axis].push_back({.lower = static_cast<std::size_t>(beams.lower[i]),
                              .upper = static_cast<std::size_t>(beams.upper[i]),
                              .axial = static_cast<Real>(axial_N[axis].at(i)),
                              .root = Real(0),
                              .direction = {},
                              .strain = Real(0),
                              .tension = Real(0)});
    }
  }
}

template <class Real>
void LateralCoupling<Real>::add_loads(const StepData<Real>& d) {
  std::fill(sums_.begin(), sums_.end(), std::array<Real, 3>{});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < beams_[axis].size(); ++i) {
      Beam& beam = beams_[axis][i];
      const Real* lower = d.pose + line_size * beam.lower;
      const Real* upper = d.pose + line_size * beam.upper;
      Real length2 = Real(0);
      for (std::size_t k = 0; k < 3; ++k) {
        beam.direction[k] = upper[k] - lower[k];
        length2 += beam.direction[k] * beam.direction[k];
      }
      const Real length = std::sqrt(length2);
      for (Real& component : beam.direction) component = length > Real(0) ? component / length : Real(0);
      const Real rest_length = rest_length_m(d, axis, i);
      beam.root = std::sqrt(beam.axial / rest_length);
      beam.strain = (length - rest_length) / rest_length;
      const Real share = Real(0.5) * beam.root * (length - rest_length);
      sums_[beam.lower][axis] += share;
      sums_[beam.upper][axis] += share;
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    for (Beam& beam : beams_[axis]) {
      const std::array<Real, 3>& at_lower = sums_[beam.lower];
      const std::array<Real, 3>& at_upper = sums_[beam.upper];
      beam.tension = half_coupling_ * beam.root * ((at_lower[b] + at_lower[c]) + (at_upper[b] + at_upper[c]));
      Real* lower = d.load + line_size * beam.lower;
      Real* upper = d.load + line_size * beam.upper;
      for (std::size_t k = 0; k < 3; ++k) {
        const Real force = beam.tension * beam.direction[k];
        lower[k] += force;
        upper[k] -= force;
      }
    }
  }
}

template <class Real>
double LateralCoupling<Real>::energy_J() const {
  double sum = 0.0;
  for (const std::array<Real, 3>& s : sums_) sum += static_cast<double>(s[0] * s[1] + s[1] * s[2] + s[2] * s[0]);
  return 2.0 * static_cast<double>(half_coupling_) * sum;
}

template <class Real>
double LateralCoupling<Real>::rest_length_force_N(std::size_t axis, std::size_t beam) const {
  const Beam& b = beams_[axis][beam];
  return static_cast<double>(b.tension) * (1.0 + 0.5 * static_cast<double>(b.strain));
}

template class LateralCoupling<double>;
template class LateralCoupling<float>;

}  // namespace menger::voxel
