#pragma once

#include <array>
#include <cstddef>

#include "io/device/host_device.h"

namespace menger::materials {

/// A 3x3 tensor of any number type: double, float, a type of automatic differentiation, a SIMD pack. Components are not
/// initialised unless the number type does so itself.
template <class T>
struct Tensor {
  std::array<T, 9> components;  ///< row by row

  MENGER_HOST_DEVICE T& operator()(std::size_t i, std::size_t j) { return components[3 * i + j]; }
  MENGER_HOST_DEVICE const T& operator()(std::size_t i, std::size_t j) const { return components[3 * i + j]; }
};

/// The derivative of one 3x3 tensor A by another, F: d A_iJ / d F_kL, as a 9x9 matrix. Its row is 3 i + J, its column 3 k + L.
template <class T>
struct Tangent {
  std::array<T, 81> components;  ///< row by row

  T& operator()(std::size_t ij, std::size_t kl) { return components[9 * ij + kl]; }
  const T& operator()(std::size_t ij, std::size_t kl) const { return components[9 * ij + kl]; }
  T& operator()(std::size_t i, std::size_t j, std::size_t k, std::size_t l) { return (*this)(3 * i + j, 3 * k + l); }
  const T& operator()(std::size_t i, std::size_t j, std::size_t k, std::size_t l) const { return (*this)(3 * i + j, 3 * k + l); }
};

template <class T>
MENGER_HOST_DEVICE Tensor<T> identity() {
  const T one(1.0);
  const T zero(0.0);
  return {{one, zero, zero, zero, one, zero, zero, zero, one}};
}

/// Returns the cofactor matrix, cof(A) = det(A) A^-T.
template <class T>
MENGER_HOST_DEVICE Tensor<T> cofactor(const Tensor<T>& a) {
  Tensor<T> result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3;
      const std::size_t i2 = (i + 2) % 3;
      const std::size_t j1 = (j + 1) % 3;
      const std::size_t j2 = (j + 2) % 3;
      result(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    }
  }
  return result;
}

/// Returns det(A), from A and its cofactor matrix.
template <class T>
MENGER_HOST_DEVICE T determinant(const Tensor<T>& a, const Tensor<T>& cofactor_of_a) {
  return a(0, 0) * cofactor_of_a(0, 0) + a(0, 1) * cofactor_of_a(0, 1) + a(0, 2) * cofactor_of_a(0, 2);
}

template <class T>
MENGER_HOST_DEVICE T determinant(const Tensor<T>& a) {
  return determinant(a, cofactor(a));
}

/// Returns A B.
template <class T>
MENGER_HOST_DEVICE Tensor<T> product(const Tensor<T>& a, const Tensor<T>& b) {
  Tensor<T> result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return result;
}

template <class T>
MENGER_HOST_DEVICE Tensor<T> transpose(const Tensor<T>& a) {
  return {{a(0, 0), a(1, 0), a(2, 0), a(0, 1), a(1, 1), a(2, 1), a(0, 2), a(1, 2), a(2, 2)}};
}

/// Returns a A + b B.
template <class T>
MENGER_HOST_DEVICE Tensor<T> combination(const T& a, const Tensor<T>& A, const T& b, const Tensor<T>& B) {
  Tensor<T> result;
  for (std::size_t n = 0; n < 9; ++n) result.components[n] = a * A.components[n] + b * B.components[n];
  return result;
}

}  // namespace menger::materials
