#pragma once

#include <mpi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

using Index = int;  ///< of nodes; PETSc's indices are 32-bit here

/// A boundary face with its nodes, numbered lexicographically with (x_u) x (x_v) out of the solid; degree 1 uses the first four.
struct SpaceFace {
  std::size_t label;
  std::array<Index, 9> nodes;  ///< local
};

/// A segment of the rim of a virtual cap, in the direction of the rim; degree 1 has no middle node (-1).
struct RimSegment {
  Index first;  ///< local nodes
  Index middle;
  Index last;
};

/// The rim of a cap; only the first rank holds it.
struct SpaceCap {
  std::size_t chamber;
  std::vector<RimSegment> rim;
};

/// The nodes and elements of this rank, as plain arrays.
///
/// Nodes are numbered globally, each rank owning a contiguous range, and locally: owned ones first, in the order of their global
/// numbers, then those of other ranks that the elements here need (ghosts). Every node has three displacement components.
struct Space {
  MPI_Comm communicator = MPI_COMM_SELF;
  int degree = 2;
  Index node_count = 0;  ///< of all ranks
  Index first_owned = 0;
  Index owned_count = 0;
  std::vector<Index> ghosts;                     ///< global numbers, ascending
  std::vector<std::array<double, 3>> positions;  ///< of the local nodes, reference configuration, m
  std::vector<Index> element_nodes;              ///< local, (degree + 1)^3 per owned element, lexicographic, x fastest
  std::vector<std::size_t> element_regions;      ///< index into the mesh's region names
  std::vector<SpaceFace> faces;                  ///< boundary faces of owned elements
  std::vector<SpaceCap> caps;
  std::size_t element_count = 0;  ///< of all ranks

  [[nodiscard]] std::size_t nodes_per_element() const { return degree == 1 ? 8 : 27; }
  [[nodiscard]] std::size_t nodes_per_face() const { return degree == 1 ? 4 : 9; }
  [[nodiscard]] std::size_t local_element_count() const { return element_regions.size(); }
  [[nodiscard]] Index local_node_count() const { return static_cast<Index>(positions.size()); }
  [[nodiscard]] Index global_node(Index local) const {
    return local < owned_count ? first_owned + local : ghosts[static_cast<std::size_t>(local - owned_count)];
  }
};

/// The nodes of a rim, each once, ascending.
std::vector<Index> rim_nodes(const SpaceCap& cap);

/// Lagrange elements of a degree on a mesh whose elements are split `refinements` times into eight, distributed over the ranks of
/// a communicator. Nodes lie on the mesh's geometry (isoparametric elements).
/// @param degree 1 or 2 (asserts) @throws io::InputError if the mesh is none
Space make_space(const meshes::HexahedralMesh& mesh, int degree, int refinements, MPI_Comm communicator);

}  // namespace menger::fem
