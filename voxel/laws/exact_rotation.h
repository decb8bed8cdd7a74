#pragma once

#include <cmath>

#include "io/device/host_device.h"

// Functions of large rotations, computed by the C library. They are for the rare lanes outside the range of the polynomials in
// rotation.h.

namespace menger::voxel {

namespace formula {

// Templates, so that the device gets code of its own.

/// Returns 2 acos(w) / sqrt(1 - w^2); 0 for |w| >= 1.
template <class Real>
MENGER_HOST_DEVICE inline Real rotation_vector_factor(Real w) {
  const Real sine2 = Real(1) - w * w;
  if (!(sine2 > Real(0))) return Real(0);
  return Real(2) * std::acos(w) / std::sqrt(sine2);
}

/// Return cos(sqrt(x)) and sin(sqrt(x)) / sqrt(x) for x >= 0.
template <class Real>
MENGER_HOST_DEVICE inline Real cosine_of_root(Real x) {
  return std::cos(std::sqrt(x));
}
template <class Real>
MENGER_HOST_DEVICE inline Real sinc_of_root(Real x) {
  const Real root = std::sqrt(x);
  return root > Real(0) ? std::sin(root) / root : Real(1);
}

}  // namespace formula

/// These formulas as functions of the host. They are compiled once, for the baseline: a copy compiled for one instruction set
/// must not be linked into code for another.
double exact_rotation_vector_factor(double w);
double exact_cosine_of_root(double x);
double exact_sinc_of_root(double x);

/// The formulas where the code runs.
struct ExactRotationVectorFactor {
  [[gnu::always_inline]] MENGER_HOST_DEVICE double operator()(double w) const {
#if defined(__CUDA_ARCH__)
    return formula::rotation_vector_factor(w);
#else
    return exact_rotation_vector_factor(w);
#endif
  }
};
struct ExactCosineOfRoot {
  [[gnu::always_inline]] MENGER_HOST_DEVICE double operator()(double x) const {
#if defined(__CUDA_ARCH__)
    return formula::cosine_of_root(x);
#else
    return exact_cosine_of_root(x);
#endif
  }
};
struct ExactSincOfRoot {
  [[gnu::always_inline]] MENGER_HOST_DEVICE double operator()(double x) const {
#if defined(__CUDA_ARCH__)
    return formula::sinc_of_root(x);
#else
    return exact_sinc_of_root(x);
#endif
  }
};

}  // namespace menger::voxel
