#pragma once

// A Maxwell branch at one Gauss point of explicit elements, for packs. Included only by the kernels of an instruction set.

#include <array>
#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "fem/elements/inverse_cube_root.h"

namespace menger::fem::detail {

/// The cofactor of F and J = det F at a point of an element.
template <class Pack>
struct PointVolume {
  std::array<Pack, 9> cofactor;
  Pack ratio;
};

/// A symmetric tensor, by its components xx, yy, zz, yz, xz, xy. Shear components are not doubled.
template <class Pack>
using Symmetric = std::array<Pack, 6>;

/// The index of component (i, j) in a symmetric tensor, at 3 i + j.
inline constexpr std::array<std::size_t, 9> symmetric_places{0, 5, 4, 5, 1, 3, 4, 3, 2};

template <class Pack>
Symmetric<Pack> load_symmetric(const double* values) {
  Symmetric<Pack> result;
  for (std::size_t c = 0; c < 6; ++c) result[c] = Pack::load_aligned(values + c * Pack::size);
  return result;
}

/// Returns M^T M.
template <class Pack>
[[gnu::always_inline]] inline Symmetric<Pack> gram(const std::array<Pack, 9>& M) {
  const auto entry = [&](std::size_t j, std::size_t k) {
    return xsimd::fma(M[j], M[k], xsimd::fma(M[3 + j], M[3 + k], M[6 + j] * M[6 + k]));
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(1, 2), entry(0, 2), entry(0, 1)};
}

/// Returns A : B.
template <class Pack>
Pack contraction(const Symmetric<Pack>& A, const Symmetric<Pack>& B) {
  const Pack off = xsimd::fma(A[3], B[3], xsimd::fma(A[4], B[4], A[5] * B[5]));
  return xsimd::fma(A[0], B[0], xsimd::fma(A[1], B[1], xsimd::fma(A[2], B[2], off + off)));
}

template <class Pack>
Pack determinant(const Symmetric<Pack>& A) {
  const Pack first = xsimd::fms(A[1], A[2], A[3] * A[3]);
  const Pack second = xsimd::fms(A[3], A[4], A[5] * A[2]);
  const Pack third = xsimd::fms(A[5], A[3], A[1] * A[4]);
  return xsimd::fma(A[0], first, xsimd::fma(A[5], second, A[4] * third));
}

/// Returns the matrix product F B of a 3x3 tensor F, row by row, and a symmetric tensor B.
template <class Pack>
std::array<Pack, 9> times_symmetric(const std::array<Pack, 9>& F, const Symmetric<Pack>& B) {
  std::array<Pack, 9> product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      product[3 * i + j] =
          xsimd::fma(F[3 * i], B[symmetric_places[j]],
                     xsimd::fma(F[3 * i + 1], B[symmetric_places[3 + j]], F[3 * i + 2] * B[symmetric_places[6 + j]]));
    }
  }
  return product;
}

/// Computes J^(-2/3) (F B - (B : C)/3 F^-T) + p cof F: the stress of the energy J^(-2/3) (B : C) / 2 for a constant B, and of a
/// pressure p.
/// @param F replaced by the stress
/// @return 1 / J
template <class Pack>
[[gnu::always_inline]] inline Pack carried_stress(const Symmetric<Pack>& B, const PointVolume<Pack>& point, const Pack& pressure,
                                                  std::array<Pack, 9>& F) {
  const Pack root = inverse_cube_root(point.ratio);
  const Pack root_square = root * root;
  const Pack inverse_ratio = root_square * root;
  const std::array<Pack, 9> carried = times_symmetric(F, B);
  Pack trace = carried[0] * F[0];
  for (std::size_t n = 1; n < 9; ++n) trace = xsimd::fma(carried[n], F[n], trace);
  const Pack by_cofactor = xsimd::fma(root_square * inverse_ratio, trace * Pack(-1.0 / 3.0), pressure);
  for (std::size_t n = 0; n < 9; ++n) F[n] = xsimd::fma(root_square, carried[n], by_cofactor * point.cofactor[n]);
  return inverse_ratio;
}

/// Sums over the points of an element while their tensors A change or are evaluated. The logarithms of the determinants are
/// computed as that of their product. This is safe because an A that began as C'^-1 is a mean of such tensors, so that its
/// determinant is neither below 1 nor large.
template <class Pack>
struct BranchSums {
  Pack contractions = Pack(0.0);         ///< contractions of A, or of its change, with C'
  Pack determinants_before = Pack(1.0);  ///< product
  Pack determinants = Pack(1.0);         ///< product
};

/// Replaces A by A + share (C'^-1 - A): its value after the time h at constant C', where share = 1 - exp(-h / tau).
/// @param tensor A, six packs, changed
/// @param mean the mean of A before and after, written
template <class Pack>
[[gnu::always_inline]] inline void relax_point(const Pack& share, const std::array<Pack, 9>& F, const PointVolume<Pack>& point,
                                               double* tensor, double* mean, BranchSums<Pack>& sums) {
  const Pack root = inverse_cube_root(point.ratio);
  const Pack root_square = root * root;
  const Pack root_fourth = root_square * root_square;
  const Symmetric<Pack> A = load_symmetric<Pack>(tensor);
  const Symmetric<Pack> rest = gram(point.cofactor);  // J^2 C^-1
  Symmetric<Pack> change;
  Symmetric<Pack> after;
  for (std::size_t c = 0; c < 6; ++c) {
    change[c] = share * xsimd::fms(root_fourth, rest[c], A[c]);
    after[c] = A[c] + change[c];
    after[c].store_aligned(tensor + c * Pack::size);
    xsimd::fma(change[c], Pack(0.5), A[c]).store_aligned(mean + c * Pack::size);
  }
  sums.contractions = xsimd::fma(root_square, contraction(change, gram(F)), sums.contractions);
  sums.determinants_before = sums.determinants_before * determinant(A);
  sums.determinants = sums.determinants * determinant(after);
}

/// Adds share A to a tensor. @param from six packs
template <class Pack>
void add_share(Symmetric<Pack>& sum, const Pack& share, const double* from) {
  const Symmetric<Pack> A = load_symmetric<Pack>(from);
  for (std::size_t c = 0; c < 6; ++c) sum[c] = xsimd::fma(share, A[c], sum[c]);
}

template <class Pack>
void store_symmetric(const Symmetric<Pack>& A, double* values) {
  for (std::size_t c = 0; c < 6; ++c) A[c].store_aligned(values + c * Pack::size);
}

/// Adds A : C' - 3 of one point to the contractions, and multiplies the determinants by det A.
template <class Pack>
void add_branch_point(const std::array<Pack, 9>& F, const PointVolume<Pack>& point, const double* tensor,
                      BranchSums<Pack>& sums) {
  const Pack root = inverse_cube_root(point.ratio);
  const Symmetric<Pack> A = load_symmetric<Pack>(tensor);
  sums.contractions = sums.contractions + xsimd::fms(root * root, contraction(A, gram(F)), Pack(3.0));
  sums.determinants = sums.determinants * determinant(A);
}

}  // namespace menger::fem::detail
