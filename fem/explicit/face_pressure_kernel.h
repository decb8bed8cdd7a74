#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace menger::fem {

/// Batches of bilinear faces under pressure. Lanes without a face repeat another one.
struct FaceBatches {
  std::size_t count = 0;
  /// Four corners per lane, which run around the face, each as three times the index of its node. Corner c of lane l of batch b
  /// is at 4 (b width + l) + c.
  const std::uint32_t* first_components = nullptr;
  const double* pressures_Pa = nullptr;  ///< per batch
};

/// Numbers of the forces of one face: four for each corner, of which the last is zero.
inline constexpr std::size_t slot_numbers_per_face = 16;

namespace detail {
struct FacePressureTable;
}

/// Kernels of one instruction set for the pressure on faces. Results of two instruction sets differ by rounding.
class FacePressureKernels {
 public:
  explicit FacePressureKernels(const detail::FacePressureTable& table);

  std::string_view instruction_set;  ///< "baseline", "avx2", "avx512"
  std::size_t width;                 ///< lanes: faces computed at once

  /// Computes the forces on the corners of each lane, N: p int N_a n dA over the face's current shape, where n is against the
  /// normal of the corners' order. The integral is exact.
  /// @param positions_m current, 3 per node, and one number more
  /// @param slots_N slot_numbers_per_face for each lane, one lane after another, aligned to 64 bytes: component i of corner c at
  /// 4 c + i
  void forces(const FaceBatches& batches, const double* positions_m, double* slots_N) const;

 private:
  const detail::FacePressureTable* table_;
};

/// Returns the kernels of the widest instruction set that this machine has.
FacePressureKernels best_face_pressure_kernels();

/// Returns all kernels that this machine can run, the portable ones first.
std::vector<FacePressureKernels> available_face_pressure_kernels();

}  // namespace menger::fem
