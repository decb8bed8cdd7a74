#pragma once

// Maxwell branches of walls and blocks.

#include <array>
#include <cstddef>

#include "fem/thin_walls/lane_number.h"
#include "materials/laws/accurate_functions.h"

namespace menger::fem::detail {

template <class T, std::size_t n>
MENGER_HOST_DEVICE std::array<T, n> difference(const std::array<T, n>& a, const std::array<T, n>& b) {
  std::array<T, n> result;
  for (std::size_t i = 0; i < n; ++i) result[i] = a[i] - b[i];
  return result;
}

/// a + share (b - a)
template <class T, std::size_t n>
MENGER_HOST_DEVICE std::array<T, n> between(const std::array<T, n>& a, const std::array<T, n>& b, const T& share) {
  std::array<T, n> result;
  for (std::size_t i = 0; i < n; ++i) result[i] = fma(share, b[i] - a[i], a[i]);
  return result;
}

/// sum + share a
template <class T, std::size_t n>
MENGER_HOST_DEVICE void add_share(std::array<T, n>& sum, const T& share, const std::array<T, n>& a) {
  for (std::size_t i = 0; i < n; ++i) sum[i] = fma(share, a[i], sum[i]);
}

template <class T, std::size_t n>
MENGER_HOST_DEVICE std::array<T, n> zeros() {
  std::array<T, n> result;
  for (std::size_t i = 0; i < n; ++i) result[i] = T(0.0);
  return result;
}

template <class T, std::size_t n>
MENGER_HOST_DEVICE void load_numbers(const NumberOf<T>* numbers, std::array<T, n>& values) {
  for (std::size_t i = 0; i < n; ++i) values[i] = Lanes<T>::load(numbers + i * Lanes<T>::count);
}

template <class T, std::size_t n>
MENGER_HOST_DEVICE void store_numbers(const std::array<T, n>& values, NumberOf<T>* numbers) {
  for (std::size_t i = 0; i < n; ++i) Lanes<T>::store(values[i], numbers + i * Lanes<T>::count);
}

/// A symmetric tensor: 11, 22, 33, 23, 13, 12.
template <class T>
using SymmetricTensor = std::array<T, 6>;

/// Returns the matrix of cofactors, det(a) a^-1.
template <class T>
MENGER_HOST_DEVICE SymmetricTensor<T> cofactor(const SymmetricTensor<T>& a) {
  return {fms(a[1], a[2], a[3] * a[3]), fms(a[0], a[2], a[4] * a[4]), fms(a[0], a[1], a[5] * a[5]),
          fms(a[4], a[5], a[0] * a[3]), fms(a[3], a[5], a[1] * a[4]), fms(a[3], a[4], a[2] * a[5])};
}

/// @param cofactors of a
template <class T>
MENGER_HOST_DEVICE T determinant(const SymmetricTensor<T>& a, const SymmetricTensor<T>& cofactors) {
  return fma(a[0], cofactors[0], fma(a[5], cofactors[5], a[4] * cofactors[4]));
}

/// a : b
template <class T>
MENGER_HOST_DEVICE T contraction(const SymmetricTensor<T>& a, const SymmetricTensor<T>& b) {
  const T diagonal = fma(a[0], b[0], fma(a[1], b[1], a[2] * b[2]));
  return fma(T(2.0), fma(a[3], b[3], fma(a[4], b[4], a[5] * b[5])), diagonal);
}

/// Returns by how much A : C - ln det A falls where a branch's tensor A goes from `before` to `after` at fixed C = F^T F: its
/// energy in units of half its modulus. Precondition: `before` and `after` are positive definite.
///
/// With D = after - before and Z = before^-1 D this is (before^-1 - C) : D + (ln det(1 + Z) - tr Z). Near rest, where before is
/// C^-1, both are of second order. Differences of A : C and of ln det A are of first order: they cancel, and what rounding leaves
/// of them in single precision would be far larger than the fall.
template <class T>
MENGER_HOST_DEVICE T energy_fall(const SymmetricTensor<T>& before, const SymmetricTensor<T>& after, const SymmetricTensor<T>& C) {
  const SymmetricTensor<T> change = difference(after, before);
  const SymmetricTensor<T> cofactors = cofactor(before);
  const T inverse_determinant = T(1.0) / determinant(before, cofactors);
  SymmetricTensor<T> inverse;
  for (std::size_t i = 0; i < 6; ++i) inverse[i] = inverse_determinant * cofactors[i];
  const SymmetricTensor<T> changed_cofactors = cofactor(change);
  // invariants of Z: det(1 + Z) = 1 + trace + second + third; the trace of cofactor(D) D is 3 det D
  const T trace = contraction(inverse, change);
  const T second = inverse_determinant * contraction(before, changed_cofactors);
  const T third = inverse_determinant * T(1.0 / 3.0) * contraction(change, changed_cofactors);
  const T higher = second + third;
  return contraction(difference(inverse, C), change) + (higher - materials::log_remainder<T>(trace + higher));
}

/// Where the branch of a wall is at rest.
template <class T>
struct WallBranch {
  bool is_there = true;
  std::array<std::array<T, 4>, 2> tensors;  ///< A: 11, 22, 12, 33
  std::array<T, 2> shears;
  std::array<T, 9> strains;

  MENGER_HOST_DEVICE void load(const NumberOf<T>* numbers) {
    constexpr std::size_t width = Lanes<T>::count;
    load_numbers(numbers, tensors[0]);
    load_numbers(numbers + 4 * width, tensors[1]);
    load_numbers(numbers + 8 * width, shears);
    load_numbers(numbers + 10 * width, strains);
  }
  MENGER_HOST_DEVICE void store(NumberOf<T>* numbers) const {
    constexpr std::size_t width = Lanes<T>::count;
    store_numbers(tensors[0], numbers);
    store_numbers(tensors[1], numbers + 4 * width);
    store_numbers(shears, numbers + 8 * width);
    store_numbers(strains, numbers + 10 * width);
  }
  [[nodiscard]] MENGER_HOST_DEVICE WallBranch moved_to(const WallBranch& other, const T& share) const {
    return {true,
            {between(tensors[0], other.tensors[0], share), between(tensors[1], other.tensors[1], share)},
            between(shears, other.shears, share),
            between(strains, other.strains, share)};
  }
  [[nodiscard]] MENGER_HOST_DEVICE static WallBranch zero() {
    return {true, {zeros<T, 4>(), zeros<T, 4>()}, zeros<T, 2>(), zeros<T, 9>()};
  }
  MENGER_HOST_DEVICE void add(const T& share, const WallBranch& other) {
    for (std::size_t z = 0; z < 2; ++z) add_share(tensors[z], share, other.tensors[z]);
    add_share(shears, share, other.shears);
    add_share(strains, share, other.strains);
  }
};

/// Where the branch of a block is at rest.
template <class T>
struct BlockBranch {
  bool is_there = true;
  SymmetricTensor<T> tensor;  ///< A
  std::array<T, 12> strains;

  MENGER_HOST_DEVICE void load(const NumberOf<T>* numbers) {
    load_numbers(numbers, tensor);
    load_numbers(numbers + 6 * Lanes<T>::count, strains);
  }
  MENGER_HOST_DEVICE void store(NumberOf<T>* numbers) const {
    store_numbers(tensor, numbers);
    store_numbers(strains, numbers + 6 * Lanes<T>::count);
  }
  [[nodiscard]] MENGER_HOST_DEVICE BlockBranch moved_to(const BlockBranch& other, const T& share) const {
    return {true, between(tensor, other.tensor, share), between(strains, other.strains, share)};
  }
  [[nodiscard]] MENGER_HOST_DEVICE static BlockBranch zero() { return {true, zeros<T, 6>(), zeros<T, 12>()}; }
  MENGER_HOST_DEVICE void add(const T& share, const BlockBranch& other) {
    add_share(tensor, share, other.tensor);
    add_share(strains, share, other.strains);
  }
};

/// Lets the branches of elements go their shares of the way to rest.
/// @param values of their first set, changed as all sets are
/// @param relax_one lets one branch go: called with its number, its values and where it rests, returns its mean of before and
/// after
/// @return the mean of before and after, over all branches by their moduli
template <class Branch, class T, class Task, class Number, class RelaxOne>
MENGER_HOST_DEVICE Branch relax_all(const Task& task, Number* values, const Branch& rest, const RelaxOne& relax_one) {
  if (task.branch_count == 1) return relax_one(std::size_t{0}, values, rest);
  Branch after = Branch::zero();
  Branch mean = Branch::zero();
  for (std::size_t n = 0; n < task.branch_count; ++n) {
    Number* own = values + (n + 1) * task.sets_apart;
    const T weight = T(task.branch_ratios[n] / task.branch_ratio);
    mean.add(weight, relax_one(n, own, rest));
    Branch here;
    here.load(own);
    after.add(weight, here);
  }
  after.store(values);
  return mean;
}

/// Calls `use(n, values)` with the values of each branch.
template <class Task, class Number, class Use>
MENGER_HOST_DEVICE void for_each_branch(const Task& task, const Number* values, const Use& use) {
  for (std::size_t n = 0; n < task.branch_count; ++n)
    use(n, task.branch_count == 1 ? values : values + (n + 1) * task.sets_apart);
}

}  // namespace menger::fem::detail
