// Bending: a slender cantilever against Timoshenko's beam, and Cook's membrane of a nearly incompressible body.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "fem_cooks_membrane.h"
#include "fem_table.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/verification_shapes.h"

namespace menger::fem {
namespace {

/// Tip deflection, m, of a beam 20 x 1 x 1 mm without lateral contraction (kappa = 2/3 mu, so E = 2 mu), clamped at one end,
/// under a transverse traction of 0.01 Pa on the other: a deflection of 1e-5 of its length.
double cantilever_deflection_m(int degree, Formulation formulation, std::size_t elements_along) {
  constexpr double shear_modulus_Pa = 30e3;
  const meshes::HexahedralMesh mesh =
      meshes::box({0.02, 1e-3, 1e-3}, {elements_along, 1, std::max<std::size_t>(elements_along / 20, 1)});
  Body body =
      body_of(materials::NeoHookean{shear_modulus_Pa}, materials::SimoTaylorVolume{2.0 / 3.0 * shear_modulus_Pa}, formulation);
  hold(body, mesh, "x min", {true, true, true});
  body.tractions = {{meshes::label_index(mesh, "x max"), {0.0, 0.0, 1e-2}}};
  Model model(mesh, degree, body);
  model.follow({});
  return model.displacement_at({0.02, 0.0, 0.0})[2];
}

/// F L^3 / 3 E I + F L / k G A with the shear coefficient 5/6 of a rectangle without lateral contraction.
double timoshenko_deflection_m() {
  constexpr double length = 0.02, height = 1e-3, force_N = 1e-2 * height * height, shear_modulus_Pa = 30e3;
  constexpr double inertia = height * height * height * height / 12.0;
  return force_N * length * length * length / (3.0 * 2.0 * shear_modulus_Pa * inertia) +
         force_N * length / (5.0 / 6.0 * shear_modulus_Pa * height * height);
}

/// The clamp also hinders the warping of the section, which a beam does not know: below 1e-4 of the deflection at this
/// slenderness. Twenty cubes of Q2 are 3e-4 too stiff.
TEST(Cantilever, DeflectsAsTimoshenkosBeam) {
  for (const Formulation formulation : {Formulation::three_field, Formulation::displacement}) {
    const std::string name = formulation == Formulation::displacement ? "Q2" : "Q2/P1";
    expect_close("cantilever " + name + " 20 x 1 x 1, tip m", cantilever_deflection_m(2, formulation, 20),
                 timoshenko_deflection_m(), 1e-3);
  }
}

TEST(Cantilever, ConvergesWithTheSquareOfTheElements) {
  std::vector<double> tips_m;
  for (const std::size_t elements : {40U, 80U, 160U})
    tips_m.push_back(cantilever_deflection_m(1, Formulation::displacement, elements));
  expect_order("cantilever Q1 160 x 1 x 8, tip m", tips_m, timoshenko_deflection_m(), 2.0, 0.1);
}

/// The published deflection is that of another element on 128 x 128 of them; the strong corner at the clamp makes convergence
/// slow.
TEST(CooksMembrane, MixedElementsDoNotLock) {
  expect_close("Cook Q2/P1 8 x 8, tip mm", cook_tip_mm(2, Formulation::three_field, 8), published_cook_tip_mm, 5e-3);
  expect_close("Cook Q1/P0 16 x 16, tip mm", cook_tip_mm(1, Formulation::three_field, 16), published_cook_tip_mm, 2e-2);
}

TEST(CooksMembrane, DisplacementElementsLock) {
  EXPECT_LT(cook_tip_mm(1, Formulation::displacement, 16), 0.4 * published_cook_tip_mm);
  EXPECT_LT(cook_tip_mm(2, Formulation::displacement, 4), 0.9 * published_cook_tip_mm);
}

}  // namespace
}  // namespace menger::fem
