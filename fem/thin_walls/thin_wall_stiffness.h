#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "fem/thin_walls/thin_wall_kernel.h"

namespace menger::fem {

/// Displacements, forces or gradients of one element: component i of corner a at 3 a + i, corners with x fastest.
using BoxNumbers = std::array<double, 24>;

/// A batch of elements of one kind and normal, at most one in each lane.
struct ThinWallBatch {
  ThinWallElement element = ThinWallElement::wall;
  std::size_t normal = 2;
  std::vector<std::array<double, 3>> edges_m;  ///< along x, y and z, one for each element
};

/// Energies, forces and stiffness of batches in double precision, for methods that solve for an equilibrium.
///
/// The stiffness is the central difference of the forces over the 24 components of an element, and symmetric: each entry is the
/// mean of the two differences that approximate it. The step is difference_step of the shortest edge. Its error is that of
/// rounding, 1e-11 of the largest entry, and of the third derivative of the forces, some 1e-10 of it.
class ThinWallStiffness {
 public:
  /// Step of the differences, as a part of the shortest edge of an element.
  static constexpr double difference_step = 1e-5;

  explicit ThinWallStiffness(ThinWallKernels<double> kernels = best_thin_wall_kernels<double>());

  /// How many elements a batch may hold.
  [[nodiscard]] std::size_t width() const { return kernels_.width; }

  /// Chooses the batch and the displacements, 24 of each element, one element after another, for what follows.
  void place(const ThinWallBatch& batch, std::span<const double> displacements_m);

  /// Energy of each element without that of the pressures on its faces, J, and its smallest ratio (see ThinWallOutcome).
  void compute_energies(const ThinWallMaterial& material);
  [[nodiscard]] double energy_J(std::size_t element) const { return energies_[element]; }
  [[nodiscard]] double smallest_ratio(std::size_t element) const { return ratios_[element]; }

  void compute_forces(const ThinWallMaterial& material);
  [[nodiscard]] const BoxNumbers& forces_N(std::size_t element) const { return forces_[element]; }

  void compute_stiffness(const ThinWallMaterial& material);
  /// 24 x 24 numbers, row by row, N/m.
  [[nodiscard]] std::span<const double> stiffness(std::size_t element) const {
    return std::span(stiffness_).subspan(576 * element, 576);
  }

 private:
  using Numbers = std::vector<double, xsimd::aligned_allocator<double, 64>>;

  [[nodiscard]] ThinWallBatches<double> batches() const;
  void call_forces(const ThinWallMaterial& material);
  /// Component n, in the order of BoxNumbers, of the forces that were computed last.
  [[nodiscard]] double slot(std::size_t lane, std::size_t n) const {
    const std::size_t corner = corner_of_global_[normal_][n / 3];
    return slots_[4 * kernels_.slot(lane, corner) + n % 3];
  }

  ThinWallKernels<double> kernels_;
  // By normal: where the corners of each lane have their first component, and the local corner of each global one.
  std::array<std::vector<std::uint32_t>, 3> first_components_;
  std::array<std::array<std::size_t, 8>, 3> corner_of_global_{};
  ThinWallElement element_ = ThinWallElement::wall;
  std::uint8_t normal_ = 2;
  std::size_t count_ = 0;
  Numbers shapes_;
  Numbers displacements_;
  Numbers slots_;
  Numbers energies_;
  Numbers ratios_;
  std::vector<double> steps_m_;
  std::vector<BoxNumbers> forces_;
  std::vector<double> stiffness_;
};

}  // namespace menger::fem
