#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <tuple>

#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/nearly_incompressible.h"

namespace menger::materials {

/// One of each law with round numbers (Pa), all with different shear moduli.
inline auto sample_laws() {
  return std::tuple{NeoHookean{50e3},
                    MooneyRivlin{20e3, 5e3},
                    Yeoh{21e3, 2.5e3, 0.1e3},
                    Ogden<1>{{OgdenTerm{25e3, 3.25}}},
                    Ogden<2>{{OgdenTerm{60e3, 1.5}, OgdenTerm{-2.5e3, -4.0}}},
                    Ogden<3>{{OgdenTerm{10e3, 2.0}, OgdenTerm{20e3, 1.3}, OgdenTerm{-3e3, -2.5}}},
                    Gent{46e3, 20.0},
                    ArrudaBoyce{32e3, 1.6}};
}

/// Calls f with one of each law.
template <class F>
void for_each_law(F&& f) {
  std::apply([&](const auto&... laws) { (f(laws), ...); }, sample_laws());
}

template <class Law>
auto with_volume(const Law& law) {
  return NearlyIncompressible<Law, SimoTaylorVolume>{law, {1e6}};
}

/// F = 1 + amplitude times random numbers in [-1, 1].
inline Tensor<double> random_deformation(double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  Tensor<double> F = identity<double>();
  for (double& component : F.components)
    component += amplitude * (2.0 * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max()) - 1.0);
  return F;
}

/// Rotation by `angle` about the direction (1, 2, 3).
inline Tensor<double> rotation(double angle) {
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  const std::array<double, 3> n{1.0 / std::sqrt(14.0), 2.0 / std::sqrt(14.0), 3.0 / std::sqrt(14.0)};
  const Tensor<double> cross{{0.0, -n[2], n[1], n[2], 0.0, -n[0], -n[1], n[0], 0.0}};
  Tensor<double> Q;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) Q(i, j) = (i == j ? c : 0.0) + (1.0 - c) * n[i] * n[j] + s * cross(i, j);
  return Q;
}

inline Tensor<double> diagonal(double a, double b, double c) { return {{a, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, c}}; }

inline double largest(const auto& components) {
  double result = 0.0;
  for (const double component : components) result = std::max(result, std::abs(component));
  return result;
}

inline double distance(const auto& a, const auto& b) {
  double result = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) result = std::max(result, std::abs(a[n] - b[n]));
  return result;
}

}  // namespace menger::materials
