#pragma once

#include <vector>

#include "meshes/design/reference_shapes.h"
#include "voxel/statics/equilibrium.h"

namespace menger::voxel {

inline constexpr double sample_edge = 0.01;    ///< m
inline constexpr double sample_modulus = 1e5;  ///< Pa

/// Parameters of equal moduli for all classes; lengths and walls do not response to pressure.
inline SurrogateParameters sample_parameters() {
  SurrogateParameters parameters;
  parameters.silicone = "sample";
  parameters.cell_edge_m = sample_edge;
  parameters.wall_thickness_m = 0.002;
  parameters.density_kg_m3 = 1000.0;
  parameters.axial_Pa.fill(sample_modulus);
  parameters.bending_Pa.fill(sample_modulus);
  parameters.torsion_Pa.fill(sample_modulus);
  parameters.ground_stiffness_N_per_m = 500.0;
  return parameters;
}

/// Stiffness of the section of a solid voxel: EA (N) and EI = GJ (N m^2).
inline double sample_axial() { return sample_modulus * sample_edge * sample_edge; }
inline double sample_bending() { return sample_modulus * sample_edge * sample_edge * sample_edge * sample_edge / 12.0; }

inline HollowVoxels sample_voxels(const meshes::Polycube& cells, meshes::ChamberLayout layout = meshes::ChamberLayout::single) {
  return hollow_voxels(cells, {sample_edge, 0.002, 1, 1, layout});
}

inline StaticBody sample_body(const meshes::Polycube& cells, const std::vector<meshes::Side>& plates,
                              const SurrogateParameters& parameters = sample_parameters()) {
  return {parameters, sample_voxels(cells), plates};
}

/// The same pressure in the only chamber.
inline StaticLoads under_pressure(double pressure_Pa) {
  StaticLoads loads;
  loads.pressures_Pa = {pressure_Pa};
  return loads;
}

/// Base plate at rest, tip plate moved.
inline StaticLoads tip_moved(const Vector3<double>& displacement, const Vector3<double>& rotation) {
  StaticLoads loads = under_pressure(0.0);
  loads.plates = {PlateMotion{}, PlateMotion{displacement, rotation}};
  return loads;
}

}  // namespace menger::voxel
