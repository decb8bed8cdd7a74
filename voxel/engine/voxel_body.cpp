#include "voxel/engine/voxel_body.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "voxel/engine/time_step.h"
#include "voxel/model/actuation.h"
#include "voxel/model/calibrated_body.h"

namespace menger::voxel {

namespace {

/// Returns the wave speed of the stiffest and lightest material of a body of solid voxels.
double wave_speed_m_s(const Lattice& lattice, const Physics& physics) {
  double fastest = 0.0;
  for (const meshes::Material material : lattice.material) {
    const VoxelMaterial& m = physics.materials[static_cast<std::size_t>(material - 1)];
    fastest = std::max(fastest, std::sqrt(m.youngs_modulus_Pa / m.density_kg_m3));
  }
  return fastest;
}

/// Returns the wave speed of a calibrated body, as if every voxel with its mass were repeated without end along its stiffest
/// axis.
double wave_speed_m_s(const HollowVoxels& voxels, const BodyClasses& classes, const SurrogateParameters& parameters) {
  const double edge = parameters.voxel_edge_m();
  double fastest = 0.0;
  for (std::size_t i = 0; i < classes.mass_kg.size(); ++i) {
    for (const std::uint8_t c : voxels.wall_class[i])
      fastest = std::max(fastest, std::sqrt(parameters.axial_Pa[c] * edge * edge * edge / classes.mass_kg[i]));
  }
  return fastest;
}

}  // namespace

VoxelBody::VoxelBody(const meshes::Polycube& body, double cell_edge_m, const Physics& given, const std::vector<bool>& fixed)
    : physics(given),
      hollow(physics.surrogate ? std::optional(calibrated_voxels(body, *physics.surrogate)) : std::nullopt),
      lattice(hollow ? hollow->body : body),
      edge_m(hollow ? physics.surrogate->parameters.voxel_edge_m() : cell_edge_m),
      classes(hollow ? calibrated_classes(lattice, *hollow, physics, fixed) : solid_classes(lattice, edge_m, physics, fixed)),
      phases(actuation_phases(lattice, physics.actuation)),
      time_step_s(physics.integration.time_step_fraction * (hollow ? recommended_time_step_s(lattice, classes, edge_m, physics)
                                                                   : recommended_time_step_s(lattice, edge_m, physics))),
      speed_limit_m_s(physics.limits.speed_fraction * (hollow ? wave_speed_m_s(*hollow, classes, physics.surrogate->parameters)
                                                              : wave_speed_m_s(lattice, physics))) {}

meshes::CellIndex VoxelBody::cell_of(std::size_t voxel) const {
  const meshes::CellIndex& place = lattice.cells[voxel];
  const int parts = hollow ? physics.surrogate->parameters.voxels_per_cell : 1;
  return {place.x / parts, place.y / parts, place.z / parts};
}

}  // namespace menger::voxel
