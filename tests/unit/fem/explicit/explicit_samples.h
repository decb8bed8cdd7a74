#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "fem/explicit/explicit_dynamics.h"
#include "fem/explicit/three_field_elements.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/verification_shapes.h"

namespace menger::fem {

/// Silicone of the cross-code hollow cube: mu = 50 kPa, kappa = 2.5 MPa.
inline ExplicitRegion silicone(double viscosity_Pa_s = 0.0) {
  return {{materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, viscosity_Pa_s}, 1070.0};
}

/// The hollow cube of 20 mm with walls of 2 mm.
inline meshes::HexahedralMesh hollow_cube(int elements_through_wall = 1, double wall_m = 2e-3) {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = wall_m;
  options.elements_through_wall = elements_through_wall;
  return meshes::hollow_polycube(meshes::hollow_cube_design(20e-3), options).mesh;
}

/// All regions of silicone.
inline ExplicitBodyOptions silicone_options(const meshes::HexahedralMesh& mesh, double viscosity_Pa_s = 0.0) {
  ExplicitBodyOptions options;
  options.regions.assign(mesh.region_names.size(), silicone(viscosity_Pa_s));
  return options;
}

/// Reproducible numbers in [-amplitude, amplitude].
inline std::vector<double> random_numbers(std::size_t count, double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<double> values(count);
  for (double& value : values)
    value = amplitude * (2.0 * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max()) - 1.0);
  return values;
}

/// The elements of a body with mean dilatation.
inline const ThreeFieldElements& three_field(const ExplicitBody& body) {
  return dynamic_cast<const ThreeFieldElements&>(body.elements());
}

/// Branches of such a body at rest at these displacements.
inline AlignedNumbers branches_at_rest(const ExplicitBody& body, const std::vector<double>& displacements) {
  return std::get<AlignedNumbers>(body.elements().branches_at_rest(displacements));
}

inline double strain_energy_J(const ExplicitBody& body, const std::vector<double>& displacements,
                              const AlignedNumbers& branch = {}) {
  return body.elements().strain_energy_J(displacements, branch);
}

/// Internal force on each component of each node, N.
inline std::vector<double> internal_forces(const ExplicitBody& body, const NodalMotion& motion,
                                           const BranchTensors& branch = {}) {
  AlignedNumbers slots(24 * three_field(body).boxes().width() * three_field(body).boxes().batch_count());
  three_field(body).forces(motion, {0, three_field(body).boxes().batch_count()}, branch, slots.data());
  std::vector<double> forces(3 * body.node_count(), 0.0);
  const NodeSlots& of_nodes = three_field(body).boxes().slots();
  for (std::size_t node = 0; node < body.node_count(); ++node)
    for (const std::uint32_t slot : of_nodes.of(node))
      for (std::size_t i = 0; i < 3; ++i) forces[3 * node + i] += slots[slot + i * of_nodes.stride];
  return forces;
}

/// Node of a mesh at a place.
inline std::size_t node_at(const meshes::HexahedralMesh& mesh, const Point& place) {
  std::size_t nearest = 0;
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    if (norm(difference(mesh.points[n], place)) < norm(difference(mesh.points[nearest], place))) nearest = n;
  return nearest;
}

/// What a body without loads keeps.
struct Motion {
  Point momentum{};   ///< kg m/s
  Point angular{};    ///< kg m^2/s, about the origin
  double size = 0.0;  ///< sum of the sizes of all nodes' momenta
};

inline Motion motion_of(ExplicitDynamics& dynamics) {
  Motion result;
  const std::vector<double> x = dynamics.positions_m();
  const std::vector<double> v = dynamics.velocities_m_per_s();
  const std::vector<double>& masses_kg = dynamics.body().masses_kg();
  for (std::size_t n = 0; n < masses_kg.size(); ++n) {
    const Point p = scaled(masses_kg[n], {v[3 * n], v[3 * n + 1], v[3 * n + 2]});
    result.momentum = sum(result.momentum, p);
    result.angular = sum(result.angular, cross({x[3 * n], x[3 * n + 1], x[3 * n + 2]}, p));
    result.size += norm(p);
  }
  return result;
}

}  // namespace menger::fem
