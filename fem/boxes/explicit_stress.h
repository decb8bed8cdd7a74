#pragma once

// Stress of one Gauss point of explicit elements, for packs. Included only by the kernels of an instruction set.

#include <array>
#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "fem/boxes/explicit_branch.h"
#include "fem/boxes/explicit_kernel_table.h"
#include "fem/elements/inverse_cube_root.h"
#include "fem/elements/pack_laws.h"

namespace menger::fem::detail {

/// Returns only the derivative: the logarithm in an energy costs as much as a whole point.
template <class Law, class Pack>
Pack pack_volume_derivative(const void* law, const Pack& ratio) {
  return static_cast<const Law*>(law)->derivative(ratio);
}

template <class Pack, class... Laws>
constexpr std::array<Pack (*)(const void*, const Pack&), sizeof...(Laws)> volume_derivatives(const std::variant<Laws...>*) {
  return {pack_volume_derivative<Laws, Pack>...};
}

template <class Pack>
Pack volume_derivative(const LawReference& volume, const Pack& ratio) {
  static constexpr auto laws = volume_derivatives<Pack>(static_cast<const VolumetricLaw*>(nullptr));
  return laws[volume.index](volume.parameters, ratio);
}

/// Computes the Neo-Hookean isochoric stress plus p cof F: P = mu J^(-2/3) (F - tr(C)/3 F^-T). J^(-1/3) comes from one series,
/// without root and division. For laws of any other kind see GeneralStress.
template <class Pack>
class NeoHookeanStress {
 public:
  explicit NeoHookeanStress(const ExplicitTask& task)
      : shear_modulus_(static_cast<const materials::NeoHookean*>(task.law.parameters)->shear_modulus_Pa) {}

  /// Computes the stress.
  /// @param F replaced by P
  /// @param admissible unchanged: the law has a stress wherever J > 0
  /// @return 1 / J
  Pack operator()(const PointVolume<Pack>& point, const double* /*tensor*/, const Pack& pressure, std::array<Pack, 9>& F,
                  Pack& admissible) const {
    static_cast<void>(admissible);
    const Pack root = inverse_cube_root(point.ratio);
    const Pack root_square = root * root;
    const Pack inverse_ratio = root_square * root;
    Pack square = F[0] * F[0];
    for (std::size_t n = 1; n < 9; ++n) square = xsimd::fma(F[n], F[n], square);
    const Pack by_gradient = shear_modulus_ * root_square;
    const Pack by_cofactor = xsimd::fma(by_gradient * inverse_ratio, square * Pack(-1.0 / 3.0), pressure);
    for (std::size_t n = 0; n < 9; ++n) F[n] = xsimd::fma(by_gradient, F[n], by_cofactor * point.cofactor[n]);
    return inverse_ratio;
  }

 private:
  Pack shear_modulus_;
};

/// Computes the same with a branch. Both energies are linear in C, so that mu I + m A gives the sum of both stresses.
template <class Pack>
class BranchedNeoHookeanStress {
 public:
  explicit BranchedNeoHookeanStress(const ExplicitTask& task)
      : shear_modulus_(static_cast<const materials::NeoHookean*>(task.law.parameters)->shear_modulus_Pa),
        branch_modulus_(task.branch.shear_modulus_Pa) {}

  /// Computes the stress.
  /// @param tensor A of the branch
  Pack operator()(const PointVolume<Pack>& point, const double* tensor, const Pack& pressure, std::array<Pack, 9>& F,
                  Pack& admissible) const {
    static_cast<void>(admissible);
    Symmetric<Pack> both = load_symmetric<Pack>(tensor);
    for (std::size_t c = 0; c < 3; ++c) both[c] = xsimd::fma(branch_modulus_, both[c], shear_modulus_);
    for (std::size_t c = 3; c < 6; ++c) both[c] = branch_modulus_ * both[c];
    return carried_stress(both, point, pressure, F);
  }

 private:
  Pack shear_modulus_;
  Pack branch_modulus_;
};

/// Computes the stress of any law, through the functions that the implicit elements use.
template <class Pack>
class GeneralStress {
 public:
  explicit GeneralStress(const ExplicitTask& task) : law_(task.law) {}

  /// Computes the stress.
  /// @param F replaced by P
  /// @param admissible not positive in lanes where the law gives no stress
  /// @return 1 / J
  Pack operator()(const PointVolume<Pack>& point, const double* /*tensor*/, const Pack& pressure, std::array<Pack, 9>& F,
                  Pack& admissible) const {
    static constexpr auto laws = PackTables<materials::HyperelasticLaw>::template isochoric<Pack>();
    Tensor<Pack> stress;
    Pack energy;
    admissible = xsimd::min(admissible, laws[law_.index].stress(law_.parameters, {F}, stress, energy));
    for (std::size_t n = 0; n < 9; ++n) F[n] = xsimd::fma(pressure, point.cofactor[n], stress.components[n]);
    return Pack(1.0) / point.ratio;
  }

 private:
  LawReference law_;
};

/// Computes the stress of any law with a branch.
template <class Pack>
class BranchedGeneralStress {
 public:
  explicit BranchedGeneralStress(const ExplicitTask& task) : law_(task), branch_modulus_(task.branch.shear_modulus_Pa) {}

  Pack operator()(const PointVolume<Pack>& point, const double* tensor, const Pack& pressure, std::array<Pack, 9>& F,
                  Pack& admissible) const {
    std::array<Pack, 9> carried = F;
    Symmetric<Pack> branch = load_symmetric<Pack>(tensor);
    for (Pack& component : branch) component = branch_modulus_ * component;
    carried_stress(branch, point, Pack(0.0), carried);
    const Pack inverse_ratio = law_(point, tensor, pressure, F, admissible);
    for (std::size_t n = 0; n < 9; ++n) F[n] = F[n] + carried[n];
    return inverse_ratio;
  }

 private:
  GeneralStress<Pack> law_;
  Pack branch_modulus_;
};

/// Adds the viscous stress 2 eta dev(d) F^-T, d = sym(dF/dt F^-1), to P; returns 2 eta |dev d|^2.
template <class Pack>
Pack add_viscous_stress(const Pack& twice_viscosity, const PointVolume<Pack>& point, const Pack& inverse_ratio,
                        const std::array<Pack, 9>& rate, std::array<Pack, 9>& P) {
  const auto& C = point.cofactor;
  const auto entry = [&](std::size_t i, std::size_t j) {  // of dF/dt cof(F)^T = J dF/dt F^-1
    return xsimd::fma(rate[3 * i], C[3 * j], xsimd::fma(rate[3 * i + 1], C[3 * j + 1], rate[3 * i + 2] * C[3 * j + 2]));
  };
  const Pack xx = entry(0, 0);
  const Pack yy = entry(1, 1);
  const Pack zz = entry(2, 2);
  const Pack mean = (xx + yy + zz) * Pack(1.0 / 3.0);
  const Pack factor = twice_viscosity * inverse_ratio * inverse_ratio;
  const Pack xy = (entry(0, 1) + entry(1, 0)) * Pack(0.5);
  const Pack xz = (entry(0, 2) + entry(2, 0)) * Pack(0.5);
  const Pack yz = (entry(1, 2) + entry(2, 1)) * Pack(0.5);
  const std::array<Pack, 9> d{xx - mean, xy, xz, xy, yy - mean, yz, xz, yz, zz - mean};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      Pack sum = d[3 * i] * C[j];
      sum = xsimd::fma(d[3 * i + 1], C[3 + j], sum);
      sum = xsimd::fma(d[3 * i + 2], C[6 + j], sum);
      P[3 * i + j] = xsimd::fma(factor, sum, P[3 * i + j]);
    }
  }
  const Pack diagonal = xsimd::fma(d[0], d[0], xsimd::fma(d[4], d[4], d[8] * d[8]));
  const Pack off = xsimd::fma(xy, xy, xsimd::fma(xz, xz, yz * yz));
  return factor * xsimd::fma(off, Pack(2.0), diagonal);
}

}  // namespace menger::fem::detail
