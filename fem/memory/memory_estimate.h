#pragma once

#include <cstddef>
#include <string>

#include "fem/statics/linear_solver.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// How large a body is once its mesh has become finite elements.
struct BodySize {
  double elements = 0.0;
  double unknowns = 0.0;  ///< displacements: three per node
};

/// Counts elements and unknowns without making them. @param degree of the displacements, 1 or 2
/// @param refinements how often each element is split into eight
BodySize body_size(const meshes::HexahedralMesh& mesh, int degree, int refinements);

/// Estimates the memory that equilibria of a body take at most at once, of all processes together: libraries, elements, the
/// pattern of the stiffness while it is made, the stiffness itself, and its factors or its multigrid.
///
/// Above LinearOptions::largest_direct_size automatic means the smaller one of both methods, with the analysis of the factors:
/// the solver never chooses the direct one where memory is short. Within 8 % of what was measured, see tests/benchmark/memory.md.
double estimated_memory_bytes(const BodySize& size, int degree, const LinearOptions& options);

/// Returns why a body does not fit into the memory of this machine; empty if it does.
/// "1930000 unknowns of 74752 elements need some 19 GB of memory, and there are 8.3 GB"
std::string obstacle_of_memory(const BodySize& size, int degree, const LinearOptions& options, double memory_bytes);

}  // namespace menger::fem
