#pragma once

#include "voxel/model/surrogate_parameters.h"

namespace menger::tests {

/// Returns voxel parameters for cells of 1 cm with walls of 2 mm. Values are of the order of a soft silicone; no two classes are
/// equal.
inline voxel::SurrogateParameters surrogate_example() {
  voxel::SurrogateParameters p;
  p.silicone = "soft";
  p.law = "neo-hookean";
  p.cell_edge_m = 0.01;
  p.wall_thickness_m = 0.002;
  p.validity = {.smallest_strain = -0.5, .largest_strain = 0.5, .longest_body_cells = 3, .longest_aggregate_modules = 9};
  p.validity.set_pressures(-2e3, 2e3);
  p.density_kg_m3 = 1000.0;
  for (std::size_t c = 0; c < voxel::wall_class_count; ++c) {
    const auto k = static_cast<double>(c);
    p.axial_Pa[c] = 2e4 + 5e3 * k;
    p.bending_Pa[c] = 4e4 + 3e3 * k;
    p.torsion_Pa[c] = 1e4 + 2e3 * k;
    p.extension[c] = {(4.0 - 0.5 * k) * 1e-5, 1e-4, -5e-5};
    p.bulge[c] = {1e-5 * k, 1e-4, 0.0};
  }
  p.lateral_coupling = 0.5;
  p.bulge_peak_ratio.fill(2.0);
  p.ground_stiffness_N_per_m = 400.0;
  p.bond_damping_ratio = 0.5;
  return p;
}

/// Returns parameters for the same cells with all wall classes equal, without coupling, shear and softening. Responses can be
/// computed by hand.
inline voxel::SurrogateParameters plain_surrogate_example() {
  voxel::SurrogateParameters p;
  p.silicone = "test silicone";
  p.law = "neo-Hookean 86.7 kPa";
  p.cell_edge_m = 0.01;
  p.wall_thickness_m = 0.002;
  p.validity = {.smallest_strain = -0.5, .largest_strain = 0.5, .longest_body_cells = 3, .longest_aggregate_modules = 9};
  p.validity.set_pressures(-5e3, 8e3);
  p.density_kg_m3 = 1070.0;
  p.axial_Pa.fill(160e3);
  p.bending_Pa.fill(200e3);
  p.torsion_Pa.fill(70e3);
  p.extension.fill({.slope_per_Pa = 3e-6});
  p.bulge.fill({.slope_per_Pa = 6e-6});
  p.ground_stiffness_N_per_m = 500.0;
  return p;
}

}  // namespace menger::tests
