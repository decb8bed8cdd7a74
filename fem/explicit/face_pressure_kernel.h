#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fem/thin_walls/lane_places.h"

namespace menger::fem {

/// Numbers of the half edges of one face: three along its first direction, three along its second.
inline constexpr std::size_t half_edge_numbers_per_face = 6;

/// Numbers of the forces of one face: four for each corner, of which the last is zero.
inline constexpr std::size_t slot_numbers_per_face = 16;

/// Batches of bilinear faces under one pressure. Lanes without a face have one node at all four corners, and half edges of zero.
///
/// Where a face is follows from values at its corners: their positions, or their displacements and the half edges of the face at
/// rest, a parallelogram. Displacements may all be relative to the same point.
template <class Number>
struct FaceBatches {
  std::size_t count = 0;
  /// Four corners per lane, which run around the face, each as three times the index of its node. Corner c of lane l of batch b
  /// is at 4 (b width + l) + c.
  const std::uint32_t* first_components = nullptr;
  /// half_edge_numbers_per_face at rest, half of corner 1 - corner 0 and half of corner 3 - corner 0, entry n of lane l of batch
  /// b at (6 b + n) width + l, aligned to 64 bytes; nullptr: the values are positions.
  const Number* half_edges_m = nullptr;
  double pressure_Pa = 0.0;
  /// Per batch, written with the forces: the sum over the faces of the volume from the face at rest to the present one, m^3,
  /// positive against the normal of the corners' order; for positions, from the origin. Over a closed surface that is the change
  /// of the volume in it, or the volume. nullptr: not wanted.
  double* volumes_m3 = nullptr;
};

namespace detail {
template <class Number>
struct FacePressureTable;
}

/// Kernels of one instruction set and number type for the pressure on faces. Results of two instruction sets differ by rounding.
template <class Number>
class FacePressureKernels {
 public:
  explicit FacePressureKernels(const detail::FacePressureTable<Number>& table);

  std::string_view instruction_set;  ///< "baseline", "avx2", "avx512"
  std::size_t width;                 ///< lanes: faces computed at once

  /// Returns the slot of a corner among those of all batches. @param lane counted over all batches
  [[nodiscard]] std::size_t slot(std::size_t lane, std::size_t corner) const {
    return (lane / width * 4 + corner) * width + lane_places_[lane % width];
  }

  /// Computes the forces on the corners of each lane, N: p int N_a n dA over the face's current shape, where n is against the
  /// normal of the corners' order. The integral is exact.
  /// @param values_m current positions or displacements, 3 per node, and one number more
  /// @param slots_N slot_numbers_per_face for each lane of all batches, aligned to 64 bytes: component i of slot s, see slot(),
  /// at 4 s + i
  void forces(const FaceBatches<Number>& batches, const Number* values_m, Number* slots_N) const;

 private:
  LanePlaces lane_places_;
  const detail::FacePressureTable<Number>* table_;
};

extern template class FacePressureKernels<double>;
extern template class FacePressureKernels<float>;

/// Returns the kernels of the widest instruction set that this machine has.
template <class Number>
FacePressureKernels<Number> best_face_pressure_kernels();

/// Returns all kernels that this machine can run, the portable ones first.
template <class Number>
std::vector<FacePressureKernels<Number>> available_face_pressure_kernels();

}  // namespace menger::fem
