#pragma once

#include <mpi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

using Index = int;  ///< index of a node; PETSc's indices are 32-bit here

/// A boundary face with its nodes. They are numbered lexicographically in (u, v), where (x_u) x (x_v) points out of the solid.
/// Degree 1 uses only the first four.
struct SpaceFace {
  std::size_t label;
  std::array<Index, 9> nodes;  ///< local
};

/// A segment of the rim of a virtual cap, in the direction of the rim. With degree 1 there is no middle node (-1).
struct RimSegment {
  Index first;  ///< local nodes
  Index middle;
  Index last;
};

/// The rim of a cap. Only the first rank holds it.
struct SpaceCap {
  std::size_t chamber;
  std::vector<RimSegment> rim;
};

/// The nodes and elements of this rank, as plain arrays.
///
/// Nodes have global numbers, of which each rank owns a contiguous range, and local numbers. Local numbers start with the owned
/// nodes, in the order of their global numbers. Then follow the nodes of other ranks that the elements of this rank need
/// (ghosts). Every node has three displacement components.
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
  std::vector<std::size_t> mesh_elements;        ///< of each owned element: the element of the mesh that it is, or is a part of
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

/// Returns the nodes of a rim, each once, ascending.
std::vector<Index> rim_nodes(const SpaceCap& cap);

/// Creates Lagrange elements of a degree on a mesh and distributes them over the ranks of a communicator. Each element of the
/// mesh is split `refinements` times into eight. Nodes lie on the mesh's geometry (isoparametric elements).
/// @param degree 1 or 2 (asserts) @throws io::InputError if the mesh is not valid
Space make_space(const meshes::HexahedralMesh& mesh, int degree, int refinements, MPI_Comm communicator);

}  // namespace menger::fem
