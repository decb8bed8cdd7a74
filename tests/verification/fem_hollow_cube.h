#pragma once

#include "fem_model.h"
#include "meshes/hexahedra/verification_shapes.h"

namespace menger::fem {

// The hollow cube that several codes have computed: bottom held in z, and rigid motion removed.
inline constexpr double cube_edge_m = 0.02;
inline constexpr double cube_wall_m = 0.002;
inline constexpr double cube_shear_modulus_Pa = 50e3;
inline constexpr double cube_bulk_modulus_Pa = 2.5e6;

// Points of its quarter and of the whole with its axis in the z axis.
inline constexpr Point cube_top{0.0, 0.0, cube_edge_m};
inline constexpr Point cube_side{0.5 * cube_edge_m, 0.0, 0.5 * cube_edge_m};

inline Body material_of_cube(Formulation formulation) {
  return body_of(materials::NeoHookean{cube_shear_modulus_Pa}, materials::SimoTaylorVolume{cube_bulk_modulus_Pa}, formulation);
}

/// Supports and chamber of meshes::hollow_cube_quarter.
inline Body quarter_of_cube(Formulation formulation = Formulation::three_field) {
  const meshes::HexahedralMesh mesh = meshes::hollow_cube_quarter(cube_edge_m, cube_wall_m, 1);
  Body body = material_of_cube(formulation);
  hold_symmetry(body, mesh);
  hold(body, mesh, "ground", {false, false, true});
  add_chambers(body, mesh);
  return body;
}

}  // namespace menger::fem
