#pragma once

#include <vector>

#include "fem/implicit/implicit_dynamics.h"
#include "tests/unit/fem/explicit/explicit_samples.h"
#include "tests/unit/fem/statics/hollow_cube_space.h"

namespace menger::fem {

/// The body of explicit_samples.h for the implicit elements.
inline Body silicone_body(const meshes::HexahedralMesh& mesh) {
  Body body;
  body.regions.assign(mesh.region_names.size(), {materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, 1070.0});
  for (const meshes::Chamber& chamber : mesh.chambers) body.chambers.push_back({chamber.labels, chamber.plenum});
  body.plenum_count = mesh.plenum_names.size();
  return body;
}

/// A mesh, its body and its space.
struct ImplicitSample {
  meshes::HexahedralMesh mesh;
  Body body;
  Space space;
  explicit ImplicitSample(meshes::HexahedralMesh the_mesh, int degree = 1)
      : mesh(std::move(the_mesh)), body(silicone_body(mesh)), space(make_space(mesh, degree, 0, MPI_COMM_WORLD)) {}
};

/// Equal steps, however large their error.
inline ImplicitOptions equal_steps(double step_s, double spectral_radius = 1.0) {
  ImplicitOptions options;
  options.spectral_radius = spectral_radius;
  options.tolerance = 1.0;
  options.newton_tolerance = 1e-11;
  options.first_step_s = options.largest_step_s = step_s;
  return options;
}

/// A state of the body given by functions of the reference position.
template <class Displacement, class Velocity>
ImplicitState state_of(const Space& space, const Displacement& displacement, const Velocity& velocity) {
  ImplicitState state;
  state.displacements_m = at_nodes(space, displacement);
  state.velocities_m_per_s = at_nodes(space, velocity);
  return state;
}

/// The state of a body with other velocities, to go on from.
inline ImplicitState pushed(const ImplicitDynamics& dynamics, const Point& velocity) {
  ImplicitState state = dynamics.state();
  state.accelerations_m_per_s2.clear();
  state.at_start_J.reset();
  for (std::size_t n = 0; n < state.velocities_m_per_s.size(); ++n) state.velocities_m_per_s[n] += velocity[n % 3];
  return state;
}

inline Point nothing(const Point&) { return {}; }

}  // namespace menger::fem
