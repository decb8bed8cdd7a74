#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fem/boxes/node_slots.h"
#include "fem/explicit/chamber_faces.h"
#include "fem/surfaces/cap_volume.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// The surfaces of a body's chambers, made of bilinear faces, under follower pressure.
///
/// The force on node a of a face is p int N_a n dA over the face's current shape. The integral is exact; n points out of the
/// chamber's air. The force is p dV/dx_a with the volume V of the chamber, so that the work of a pressure is int p dV. The
/// pressure on a cap (see meshes::Cap) acts on the nodes of its rim.
class ExplicitChambers {
 public:
  explicit ExplicitChambers(const meshes::HexahedralMesh& mesh,
                            const FacePressureKernels<double>& kernels = best_face_pressure_kernels<double>());

  [[nodiscard]] std::size_t chamber_count() const { return plenums_.size(); }
  [[nodiscard]] std::size_t plenum_count() const { return plenum_count_; }
  /// Batches of faces for the kernels; those of a batch have the same chamber.
  [[nodiscard]] std::size_t batch_count() const { return batches_.batch_count(); }

  /// Returns the slots of the nodes in the array that set_face_forces and set_cap_forces fill: four slots for each lane of a
  /// batch, then one per node of a rim, then the empty one.
  [[nodiscard]] const FourfoldSlots& slots() const { return *slots_; }
  [[nodiscard]] std::size_t number_count() const { return number_count_; }  ///< of that array

  /// Computes the forces of a range of batches, N.
  /// @param positions_m current, 3 per node, and one number more
  /// @param pressures_Pa gauge, one per plenum
  /// @param slots_N aligned to 64 bytes
  /// @param volumes_m3 per batch, for plenum_volumes_m3; empty: not wanted
  void set_face_forces(std::span<const double> positions_m, std::span<const double> pressures_Pa, IndexRange batches,
                       std::span<double> slots_N, std::span<double> volumes_m3 = {}) const;
  /// Writes into slots_N the forces (N) of the pressure on all caps, on the nodes of their rims. The slots of faces stay.
  /// @param positions_m, pressures_Pa as in set_face_forces
  void set_cap_forces(std::span<const double> positions_m, std::span<const double> pressures_Pa, std::span<double> slots_N) const;

  /// Returns the volumes of the plena, m^3. @param volumes_m3 of set_face_forces with these positions
  [[nodiscard]] std::vector<double> plenum_volumes_m3(std::span<const double> positions_m,
                                                      std::span<const double> volumes_m3) const;

  /// Returns the sums of numbers of chambers over the chambers of each plenum.
  [[nodiscard]] std::vector<double> plenum_sums(const std::vector<double>& of_chambers) const;

  /// Returns the volumes of the chambers, m^3.
  /// @param positions_m current, 3 per node
  [[nodiscard]] std::vector<double> volumes_m3(std::span<const double> positions_m) const;

 private:
  struct Face {
    std::array<std::uint32_t, 4> first_components;  ///< three times the node; corners run around, normal out of the solid
    std::uint32_t chamber;
  };
  struct RimOfCap {
    Rim<2> rim;
    std::vector<std::uint32_t> nodes;
    std::size_t chamber;
    std::size_t first_number;
  };
  void add_faces(const meshes::HexahedralMesh& mesh, std::size_t chamber);
  void add_cap(const meshes::Cap& cap, std::size_t chamber);

  std::size_t plenum_count_;
  std::size_t number_count_ = 0;
  std::vector<std::size_t> plenums_;
  std::vector<Face> faces_;
  ChamberFaces<double> batches_;
  std::vector<RimOfCap> caps_;
  std::optional<FourfoldSlots> slots_;
};

}  // namespace menger::fem
