#pragma once

// Laws for packs, selected at run time by their index in the variants. Included only by the kernels of one instruction set.

#include <array>
#include <cstddef>
#include <variant>

#include "fem/elements/volumetric_law.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/isochoric_response.h"
#include "materials/laws/ogden_response.h"

namespace menger::fem::detail {

using materials::StressAndTangent;
using materials::Tensor;

/// Returns whether an isochoric law is defined at a deformation, lane by lane.
template <class Law, class Pack>
auto is_in_domain(const Law& law, const materials::Kinematics<Pack>& k) {
  if constexpr (requires { law.is_within_limit(k.first_excess); }) {
    return law.is_within_limit(k.first_excess);
  } else {
    return k.volume_ratio > Pack(0.0);
  }
}

/// The functions of an isochoric law at one quadrature point. They return whether the law is defined there, as 1 or -1 in each
/// lane.
template <class Pack>
struct PackLaw {
  Pack (*stress)(const void* law, const Tensor<Pack>& F, Tensor<Pack>& P, Pack& energy);
  Pack (*tangent)(const void* law, const Tensor<Pack>& F, StressAndTangent<Pack>& response, Pack& energy);
};

template <class Law, class Pack>
Pack pack_stress(const void* law, const Tensor<Pack>& F, Tensor<Pack>& P, Pack& energy) {
  const Law& this_law = *static_cast<const Law*>(law);
  const materials::Kinematics<Pack> k = materials::kinematics_of(F);
  P = materials::first_piola_stress(this_law, k);
  energy = materials::strain_energy_density(this_law, k);
  return select(is_in_domain(this_law, k), Pack(1.0), Pack(-1.0));
}

template <class Law, class Pack>
Pack pack_tangent(const void* law, const Tensor<Pack>& F, StressAndTangent<Pack>& response, Pack& energy) {
  const Law& this_law = *static_cast<const Law*>(law);
  const materials::Kinematics<Pack> k = materials::kinematics_of(F);
  response = materials::stress_and_tangent(this_law, k);
  energy = materials::strain_energy_density(this_law, k);
  return select(is_in_domain(this_law, k), Pack(1.0), Pack(-1.0));
}

/// The value and derivatives of a volumetric energy.
template <class Pack>
struct VolumeResponse {
  Pack energy;
  Pack derivative;
  Pack second_derivative;
};

template <class Law, class Pack>
VolumeResponse<Pack> pack_volume(const void* law, const Pack& ratio) {
  const Law& this_law = *static_cast<const Law*>(law);
  return {this_law.energy(ratio), this_law.derivative(ratio), this_law.second_derivative(ratio)};
}

template <class Variant>
struct PackTables;

template <class... Laws>
struct PackTables<std::variant<Laws...>> {
  template <class Pack>
  static constexpr std::array<PackLaw<Pack>, sizeof...(Laws)> isochoric() {
    return {PackLaw<Pack>{pack_stress<Laws, Pack>, pack_tangent<Laws, Pack>}...};
  }
  template <class Pack>
  static constexpr std::array<VolumeResponse<Pack> (*)(const void*, const Pack&), sizeof...(Laws)> volumetric() {
    return {pack_volume<Laws, Pack>...};
  }
};

/// A law in the form that the kernels use: its index in its variant and its parameters.
struct LawReference {
  std::size_t index;
  const void* parameters;
};

/// Returns a reference to the law that a variant holds. It is valid as long as the variant is neither changed nor moved.
template <class Variant>
LawReference reference_to(const Variant& law) {
  return {law.index(), std::visit([](const auto& any) -> const void* { return &any; }, law)};
}

}  // namespace menger::fem::detail
