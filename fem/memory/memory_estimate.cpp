#include "fem/memory/memory_estimate.h"

#include <algorithm>
#include <cmath>

#include "io/text/formatted.h"
#include "meshes/hexahedra/mesh_counts.h"

namespace menger::fem {
namespace {

constexpr double gigabyte = 1e9;

/// What a program with MPI, deal.II and PETSc takes before it has a body.
constexpr double program_bytes = 0.185e9;

/// The memory that grows with the body, in bytes. Fitted to what was measured on bodies with one to three elements through their
/// walls; tests/benchmark/memory.md has the comparison.
struct Costs {
  double direct;     ///< per unknown: elements, the stiffness with its pattern, and the smallest factors
  double fill;       ///< of the factors, per unknown and cube root of unknowns, as nested dissection fills them
  double iterative;  ///< per unknown: elements, the stiffness with its pattern, and its multigrid
};
constexpr Costs linear_costs{.direct = 4000.0, .fill = 42.0, .iterative = 3000.0};
constexpr Costs quadratic_costs{.direct = 2000.0, .fill = 130.0, .iterative = 4000.0};

/// Where the solver chooses, it analyses the factors first, and then keeps more than the iterative method needs.
constexpr double analysis_share = 1.7;

}  // namespace

BodySize body_size(const meshes::HexahedralMesh& mesh, int degree, int refinements) {
  meshes::MeshCounts counts = meshes::mesh_counts(mesh);
  for (int n = 0; n < refinements; ++n) counts = meshes::refined(counts);
  return {.elements = static_cast<double>(counts.elements), .unknowns = 3.0 * static_cast<double>(counts.nodes(degree))};
}

double estimated_memory_bytes(const BodySize& size, int degree, const LinearOptions& options) {
  const Costs& costs = degree == 1 ? linear_costs : quadratic_costs;
  const double direct = costs.direct + costs.fill * std::cbrt(size.unknowns);
  double per_unknown = direct;
  if (options.method == LinearMethod::iterative) per_unknown = costs.iterative;
  if (options.method == LinearMethod::automatic && size.unknowns > options.largest_direct_size)
    per_unknown = std::min(direct, analysis_share * costs.iterative);
  return program_bytes + per_unknown * size.unknowns;
}

std::string obstacle_of_memory(const BodySize& size, int degree, const LinearOptions& options, double memory_bytes) {
  const double needed = estimated_memory_bytes(size, degree, options);
  if (needed <= memory_bytes) return {};
  return io::shown(size.unknowns) + " unknowns of " + io::shown(size.elements) + " elements need some " +
         io::shown(needed / gigabyte, 2) + " GB of memory, and there are " + io::shown(memory_bytes / gigabyte, 2) + " GB";
}

}  // namespace menger::fem
