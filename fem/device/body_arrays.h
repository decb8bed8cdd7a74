#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fem/contact/rigid_ground.h"
#include "fem/explicit/explicit_body.h"
#include "fem/explicit/explicit_nodes.h"
#include "fem/thin_walls/thin_wall_kernel_table.h"
#include "fem/thin_walls/thin_wall_mesh.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Consecutive batches of elements of one kind and material.
template <class Number>
struct GroupView {
  std::size_t first_batch = 0;
  std::size_t batch_count = 0;
  std::size_t branch_position = 0;                         ///< of its first number among those of all branches
  std::array<double, most_branches> relaxation_times_s{};  ///< of the branches
  /// Without motion and branches, which change in time; of no velocities where the material has no viscosity.
  detail::ThinWallTask<Number> task{};
};

/// A body of thin walls in plain arrays, as the threads of a block read them. Lanes are counted over all batches; entry n of lane
/// l of batch b of arrays with N entries a lane lies at (N b + n) width + l.
template <class Number>
struct BodyView {
  std::size_t width = 0;
  std::size_t node_count = 0;
  std::size_t plenum_count = 0;
  std::size_t batch_count = 0;
  std::size_t group_count = 0;
  std::size_t face_batch_count = 0;
  std::size_t branch_set_count = 0;     ///< 0: no material has a branch
  std::size_t branch_number_count = 0;  ///< of all sets
  std::size_t sets_apart = 0;           ///< see ThinWallBranches
  bool is_viscous = false;

  const GroupView<Number>* groups = nullptr;
  const Number* sides = nullptr;        ///< see ThinWallBatches
  const std::int16_t* plena = nullptr;  ///< two per lane, see ThinWallPlace::plena

  const std::uint32_t* face_components = nullptr;  ///< four per lane of faces
  const Number* half_edges_m = nullptr;            ///< six per lane
  const std::int16_t* face_plena = nullptr;        ///< per lane; -1: it has no face

  /// Forces of a node: how many slots it has, and where each begins; slot s of a node at s node_count + node, so that
  /// neighbouring threads read neighbouring numbers. The components of a slot are `component_apart` apart.
  const std::uint8_t* slot_counts = nullptr;
  const std::uint32_t* slots = nullptr;
  std::size_t component_apart = 1;
  std::size_t numbers_per_batch = 0;  ///< of forces of elements
  std::size_t first_face_number = 0;  ///< where the forces of faces begin
  std::size_t force_number_count = 0;

  const double* inverse_masses_per_kg = nullptr;  ///< three per node
  const double* masses_kg = nullptr;
  const double* outer_areas_m2 = nullptr;
  const double* heights_m = nullptr;  ///< at rest
  bool has_ground = false;
  RigidGround ground{};
  Point gravity_m_per_s2{};
  double mass_damping_per_s = 0.0;

  /// The first number of the branch of each lane where the processor keeps it, and how far its numbers are apart there.
  const std::uint32_t* given_branches = nullptr;
  std::size_t given_apart = 1;
  std::size_t given_sets_apart = 0;
  const std::uint8_t* is_repeated = nullptr;  ///< per lane, see ThinWallMesh
};

/// Memory of one body in motion.
template <class Number>
struct StepsMemory {
  double* displacements_m = nullptr;
  double* velocities_m_per_s = nullptr;
  Number* values_m = nullptr;       ///< displacements relative to a node, and one number more
  Number* rates_m_per_s = nullptr;  ///< the same of velocities, where the body is viscous
  Number* forces_N = nullptr;
  Number* branches = nullptr;
  Number* given_branches = nullptr;      ///< as the processor keeps them
  Number* wall_volumes_m3 = nullptr;     ///< changes, one per lane
  Number* side_volumes_m3 = nullptr;     ///< two per lane
  Number* face_volumes_m3 = nullptr;     ///< one per lane of faces
  const double* pressures_Pa = nullptr;  ///< see StepsOrder
};

/// Returns why the steps of a body cannot be taken by blocks of threads, for users; empty if they can: it has to be of thin walls
/// with one law, and its chambers closed.
std::string obstacle_to_blocks(const meshes::HexahedralMesh& mesh, const ExplicitBodyOptions& options);

/// The arrays of a body, in one piece of memory that is copied as a whole to where its steps are taken.
template <class Number>
class BodyArrays {
 public:
  /// @param options those of the body, of thin walls without an obstacle_to_blocks
  /// @param width lanes of a batch: the threads that run in step
  BodyArrays(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, const ExplicitBodyOptions& options,
             const NodalLoads& loads, std::size_t width);

  /// Returns the arrays as they lie once `bytes` has been copied to an address, which is a multiple of 64.
  [[nodiscard]] BodyView<Number> place(const std::byte* address);
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  /// The place of the law of all materials in materials::HyperelasticLaw.
  [[nodiscard]] std::size_t law() const { return law_; }
  /// Numbers of the branches where the processor keeps them.
  [[nodiscard]] std::size_t given_branch_count() const { return given_branch_count_; }

 private:
  struct Group {
    GroupView<Number> view;
    std::size_t law_offset = 0;  ///< of the parameters of its law
  };
  template <class Entry>
  std::size_t add(std::span<const Entry> entries);
  void add_elements(const ThinWallMesh& walls);
  void add_groups(const ThinWallMesh& walls, const ExplicitBodyOptions& options);
  void add_faces(const meshes::HexahedralMesh& mesh);
  void add_given_branches(const meshes::HexahedralMesh& mesh, const ThinWallMesh& walls, std::size_t given_width);
  void add_slots(const ThinWallMesh& walls);

  std::vector<std::byte> bytes_;
  BodyView<Number> counts_;  ///< without addresses
  std::vector<Group> groups_;
  std::vector<std::array<std::uint32_t, 4>> faces_;  ///< nodes; those that are missing in a batch repeat one node
  std::vector<std::int16_t> face_plena_;
  std::size_t law_ = 0;
  std::size_t given_branch_count_ = 0;
  // Where the arrays begin in bytes_:
  std::size_t groups_at_ = 0, components_at_ = 0, shapes_at_ = 0, normals_at_ = 0, sides_at_ = 0, plena_at_ = 0;
  std::size_t face_components_at_ = 0, half_edges_at_ = 0, face_plena_at_ = 0, slot_counts_at_ = 0, slots_at_ = 0;
  std::size_t inverse_masses_at_ = 0, masses_at_ = 0, areas_at_ = 0, heights_at_ = 0, given_at_ = 0, repeated_at_ = 0;
};

extern template class BodyArrays<float>;
extern template class BodyArrays<double>;

}  // namespace menger::fem
