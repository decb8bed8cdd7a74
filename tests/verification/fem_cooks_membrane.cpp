#include "fem_cooks_membrane.h"

#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/verification_shapes.h"

namespace menger::fem {

double cook_tip_mm(int degree, Formulation formulation, std::size_t elements) {
  constexpr double youngs_modulus_Pa = 240.565e6, poissons_ratio = 0.4999;
  const meshes::HexahedralMesh mesh = meshes::cooks_membrane(1e-3, 1e-3, {elements, elements, 1});
  Body body = body_of(materials::NeoHookean{youngs_modulus_Pa / (2.0 * (1.0 + poissons_ratio))},
                      materials::SimoTaylorVolume{youngs_modulus_Pa / (3.0 * (1.0 - 2.0 * poissons_ratio))}, formulation);
  hold(body, mesh, "x min", {true, true, true});
  hold(body, mesh, "z min", {false, false, true});
  hold(body, mesh, "z max", {false, false, true});
  body.tractions = {{meshes::label_index(mesh, "x max"), {0.0, 100.0 / 16.0 * 1e6, 0.0}}};
  Model model(mesh, degree, body);
  model.follow({});
  return 1e3 * model.displacement_at({48e-3, 60e-3, 0.0})[1];
}

}  // namespace menger::fem
