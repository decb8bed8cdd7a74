#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "fem/boxes/aligned_numbers.h"
#include "fem/boxes/node_slots.h"
#include "fem/explicit/face_pressure_kernel.h"
#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Returns the boundary faces of a chamber. @param chamber index into the chambers of the mesh
std::vector<meshes::BoundaryFace> faces_of_chamber(const meshes::HexahedralMesh& mesh, std::size_t chamber);

/// What the places of faces are computed from.
enum class FaceValues { positions, displacements };

/// The faces of a body's chambers in batches for kernels. The faces of a batch have the same chamber.
template <class Number>
class ChamberFaces {
 public:
  /// @param left_out sorted corners of faces that are not taken
  ChamberFaces(const meshes::HexahedralMesh& mesh, FaceValues values, const FacePressureKernels<Number>& kernels,
               const std::set<meshes::FaceCorners>& left_out = {});

  [[nodiscard]] std::size_t batch_count() const { return chambers_.size(); }
  [[nodiscard]] std::size_t chamber(std::size_t batch) const { return chambers_[batch]; }
  /// Numbers of the array of forces.
  [[nodiscard]] std::size_t number_count() const { return slot_numbers_per_face * kernels_.width * batch_count(); }

  /// Appends the node and the slot of each corner of each face. @param first_slot that of the first lane's first corner
  void add_slots(std::uint32_t first_slot, std::vector<std::uint32_t>& nodes, std::vector<std::uint32_t>& slots) const;

  /// Computes the forces of the pressure on the corners of the faces, N, see FacePressureKernels::forces.
  /// @param values_m positions or displacements, 3 per node, and one number more
  /// @param pressures_Pa per chamber
  /// @param slots_N of all batches, aligned to 64 bytes
  /// @param volumes_m3 per batch, the part of its faces in the volume of the chamber, with displacements in the change of it,
  /// which is right in sum over a closed plenum; nullptr: not wanted
  void compute(IndexRange batches, const Number* values_m, std::span<const double> pressures_Pa, Number* slots_N,
               double* volumes_m3) const;

 private:
  FacePressureKernels<Number> kernels_;
  std::vector<std::uint32_t> first_components_;  ///< see FaceBatches
  std::vector<bool> has_face_;                   ///< per lane
  AlignedVector<Number> half_edges_m_;           ///< empty with positions
  std::vector<std::size_t> chambers_;            ///< per batch
};

extern template class ChamberFaces<double>;
extern template class ChamberFaces<float>;

/// Returns whether the faces of the chambers of each plenum make a closed surface together: none has a tube hole or ends at a
/// plane of symmetry. Holes between chambers of one plenum leave it closed: the pressures on both of their caps cancel.
bool has_closed_plena(const meshes::HexahedralMesh& mesh);

}  // namespace menger::fem
