#include "fem/modes/mass_matrix.h"

#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "fem/elements/element_shape_tables.h"

namespace menger::fem {

namespace {

/// Returns the mass at each quadrature point of an element, kg.
template <int degree>
auto point_masses(const Space& space, const Body& body, std::size_t element) {
  static constexpr auto shape = element_shape_tables<degree>();
  const Index* nodes = space.element_nodes.data() + element * shape.nodes;
  const double density = body.regions[space.element_regions[element]].density_kg_per_m3;
  std::array<double, shape.points> masses{};
  for (std::size_t q = 0; q < shape.points; ++q) {
    std::array<Point, 3> by_reference{};  // dX / dxi_j
    for (std::size_t a = 0; a < shape.nodes; ++a) {
      const Point& X = space.positions[static_cast<std::size_t>(nodes[a])];
      for (std::size_t j = 0; j < 3; ++j) by_reference[j] = sum(by_reference[j], scaled(shape.gradient[q][a][j], X));
    }
    masses[q] = density * shape.weight[q] * dot(by_reference[0], cross(by_reference[1], by_reference[2]));
  }
  return masses;
}

/// Adds m to those components of nodes a and b of an element's matrix that are not held.
void add_isotropic(std::vector<double>& block, std::size_t columns, std::size_t a, std::size_t b, double m,
                   std::span<const std::uint8_t> held_of_a, std::span<const std::uint8_t> held_of_b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (held_of_a[i] == 0 && held_of_b[i] == 0) block[(3 * a + i) * columns + 3 * b + i] = m;
  }
}

/// Returns the axis across a thin wall; nothing for other elements.
std::optional<std::size_t> normal_of_wall(const Space& space, const Body& body, std::size_t element) {
  if (!body.thin_walls) return std::nullopt;
  const ThinWallPlace& place = body.thin_walls->places[space.mesh_elements[element]];
  return place.element == ThinWallElement::wall ? std::optional(place.normal) : std::nullopt;
}

/// Gives the mass of a wall to its corners in its plane, as walks do. Across the wall it stays spread as its shape functions are,
/// so that a wall that turns has its inertia. Blocks keep the mass of their shape functions.
void lump_in_plane(std::size_t normal, double mass_kg, std::array<double, 64>& masses) {
  for (std::size_t a = 0; a < 8; ++a) {
    for (std::size_t b = 0; b < 8; ++b) {
      double share = 0.0;
      if (a == b) share = 1.0 / 12.0;
      if ((a ^ b) == std::size_t{1} << normal) share = 1.0 / 24.0;
      masses[8 * a + b] = share * mass_kg;
    }
  }
}

template <int degree>
void add_elements(const Assembly& assembly, const Body& body, double factor, Mat matrix) {
  static constexpr auto shape = element_shape_tables<degree>();
  constexpr std::size_t columns = 3 * shape.nodes;
  const Space& space = assembly.space();
  const std::span<const std::uint8_t> held = assembly.held();
  std::vector<double> block;
  std::vector<PetscInt> global(shape.nodes);
  std::array<double, shape.nodes * shape.nodes> nodal{};
  for (std::size_t e = 0; e < space.local_element_count(); ++e) {
    const Index* nodes = space.element_nodes.data() + e * shape.nodes;
    const auto masses = point_masses<degree>(space, body, e);
    const auto held_of = [&](std::size_t a) { return held.subspan(3 * static_cast<std::size_t>(nodes[a]), 3); };
    block.assign(columns * columns, 0.0);
    for (std::size_t a = 0; a < shape.nodes; ++a) {
      global[a] = space.global_node(nodes[a]);
      for (std::size_t b = 0; b < shape.nodes; ++b) {
        double m = 0.0;
        for (std::size_t q = 0; q < shape.points; ++q) m += masses[q] * (shape.value[q][a] * shape.value[q][b]);
        nodal[shape.nodes * a + b] = m;
      }
    }
    if constexpr (degree == 1) {
      const std::optional<std::size_t> normal = normal_of_wall(space, body, e);
      if (normal) lump_in_plane(*normal, std::accumulate(masses.begin(), masses.end(), 0.0), nodal);
    }
    for (std::size_t a = 0; a < shape.nodes; ++a)
      for (std::size_t b = 0; b < shape.nodes; ++b)
        add_isotropic(block, columns, a, b, factor * nodal[shape.nodes * a + b], held_of(a), held_of(b));
    const auto count = static_cast<PetscInt>(shape.nodes);
    petsc(MatSetValuesBlocked(matrix, count, global.data(), count, global.data(), block.data(), ADD_VALUES));
  }
}

}  // namespace

void assemble_mass(const Assembly& assembly, const Body& body, Mat mass) {
  petsc(MatZeroEntries(mass));
  add_mass(assembly, body, 1.0, mass);
}

void add_mass(const Assembly& assembly, const Body& body, double factor, Mat matrix) {
  if (assembly.space().degree == 1) {
    add_elements<1>(assembly, body, factor, matrix);
  } else {
    add_elements<2>(assembly, body, factor, matrix);
  }
  petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

double mass_of(const Space& space, const Body& body) {
  double mass = 0.0;
  for (std::size_t e = 0; e < space.local_element_count(); ++e) {
    if (space.degree == 1) {
      for (const double m : point_masses<1>(space, body, e)) mass += m;
    } else {
      for (const double m : point_masses<2>(space, body, e)) mass += m;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &mass, 1, MPI_DOUBLE, MPI_SUM, space.communicator);
  return mass;
}

}  // namespace menger::fem
