#include "fem/inflation/memory_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/text/formatted.h"

namespace menger::fem {
namespace {

constexpr double gigabyte = 1e9;

/// What a program with MPI, deal.II and PETSc takes before it has a body.
constexpr double program_bytes = 0.185e9;

/// The memory that grows with the body, in bytes. Fitted to what was measured on bodies with one to three elements through their
/// walls; fem/README.md has the comparison.
struct Costs {
  double direct;     ///< per unknown: elements, the stiffness with its pattern, and the smallest factors
  double fill;       ///< of the factors, per unknown and cube root of unknowns, as nested dissection fills them
  double iterative;  ///< per unknown: elements, the stiffness with its pattern, and its multigrid
};
constexpr Costs linear_costs{.direct = 4000.0, .fill = 42.0, .iterative = 3000.0};
constexpr Costs quadratic_costs{.direct = 2000.0, .fill = 130.0, .iterative = 4000.0};

/// Where the solver chooses, it analyses the factors first, and then keeps more than the iterative method needs.
constexpr double analysis_share = 1.7;

/// Counts the edges of the elements, each once.
std::size_t edge_count(const meshes::HexahedralMesh& mesh) {
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  edges.reserve(12 * mesh.elements.size());
  for (const meshes::ElementCorners& corners : mesh.elements) {
    for (std::size_t corner = 0; corner < 8; ++corner) {
      for (const std::size_t step : {1U, 2U, 4U})
        if ((corner & step) == 0U) edges.emplace_back(std::minmax(corners[corner], corners[corner | step]));
    }
  }
  std::sort(edges.begin(), edges.end());
  return static_cast<std::size_t>(std::unique(edges.begin(), edges.end()) - edges.begin());
}

}  // namespace

BodySize body_size(const meshes::HexahedralMesh& mesh, int degree, int refinements) {
  auto elements = static_cast<double>(mesh.elements.size());
  auto points = static_cast<double>(mesh.points.size());
  auto edges = static_cast<double>(edge_count(mesh));
  double faces = 0.5 * (6.0 * elements + static_cast<double>(mesh.faces.size()));
  for (int n = 0; n < refinements; ++n) {
    points += edges + faces + elements;
    edges = 2.0 * edges + 4.0 * faces + 6.0 * elements;
    faces = 4.0 * faces + 12.0 * elements;
    elements *= 8.0;
  }
  const double nodes = degree == 1 ? points : points + edges + faces + elements;
  return {.elements = elements, .unknowns = 3.0 * nodes};
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
