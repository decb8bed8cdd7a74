// Bars in grips against closed forms: homogeneous stretch, Saint-Venant's torsion, pure bending.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "fem_model.h"
#include "fem_table.h"
#include "materials/laws/homogeneous_deformations.h"
#include "meshes/hexahedra/verification_shapes.h"

namespace menger::fem {
namespace {

constexpr double shear_modulus_Pa = 50e3;

/// A bar along x of square section with a plate on either end.
Body gripped_bar(double length_m, double side_m, double bulk_modulus_Pa, const std::array<bool, 3>& held) {
  Body body = body_of(materials::NeoHookean{shear_modulus_Pa}, materials::SimoTaylorVolume{bulk_modulus_Pa});
  const double middle = 0.5 * side_m;
  body.plates = {{.faces = {.plane = AxisPlane{0, 0.0}}, .centre = {0.0, middle, middle}, .held = held},
                 {.faces = {.plane = AxisPlane{0, length_m}}, .centre = {length_m, middle, middle}, .held = held}};
  return body;
}

/// The reaction of the tip plate after it has moved in one leg.
PlateReaction reaction_of_tip(Model& model, const PlateDrive& tip) {
  const PathReport report =
      follow_path(model.equilibrium, PathDrives{.plates = {{}, tip}}, {},
                  [&](const PathPoint&, const BodyState& state, const PathRestart&) { model.state = state; });
  EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
  return report.points.back().plates.back();
}

// The sections of a bar between sliding plates are free to contract: the stress is that of homogeneous uniaxial tension, at any
// stretch. The formula is that of an incompressible bar: the tolerance is the stress, 1e5 Pa, over the bulk modulus.
TEST(SlidingPlates, StretchABarHomogeneously) {
  for (const double stretch : {0.7, 1.5, 2.5}) {
    Body body = gripped_bar(0.03, 0.01, 1e9, {true, false, false});
    body.supports = {{2, {false, true, false}}, {4, {false, false, true}}};  // y min and z min: symmetry
    Model model(meshes::box({0.03, 0.01, 0.01}, {3, 1, 1}), 1, body);
    const PlateReaction reaction =
        reaction_of_tip(model, {.values = {{}, {.displacement_m = {0.03 * (stretch - 1.0), 0.0, 0.0}, .rotation_rad = {}}}});
    const auto nominal =
        materials::nominal_stress(materials::NeoHookean{shear_modulus_Pa}, materials::LoadingMode::uniaxial, stretch);
    expect_close("bar between sliding plates, stretch " + std::to_string(stretch) + ", force N", reaction.force_N[0],
                 nominal.stress_Pa * 1e-4, 3e-4);
    EXPECT_NEAR(model.displacement_at({0.015, 0.01, 0.01})[1], 0.01 * (1.0 / std::sqrt(stretch) - 1.0), 3e-6);
  }
}

/// T = mu J a / l with the torsion constant 0.140577 s^4 of a square (the series of Saint-Venant). The ends cannot warp between
/// bonded plates, which stiffens about half a side at each end: bars of two lengths are compared, and the twist of what one has
/// more is taken.
TEST(BondedPlates, TwistASquareBarAsSaintVenantSays) {
  constexpr double side_m = 0.01;
  constexpr double angle_rad = 1e-3;
  std::array<double, 2> compliance{};
  const std::array<std::size_t, 2> elements{6, 12};
  for (std::size_t bar = 0; bar < 2; ++bar) {
    const double length_m = 0.5 * side_m * static_cast<double>(elements[bar]);
    Model model(meshes::box({length_m, side_m, side_m}, {elements[bar], 4, 4}), 2,
                gripped_bar(length_m, side_m, 2.5e6, {true, true, true}));
    const PlateReaction reaction =
        reaction_of_tip(model, {.values = {{}, {.displacement_m = {}, .rotation_rad = {angle_rad, 0.0, 0.0}}}});
    compliance[bar] = angle_rad / reaction.moment_N_m[0];
  }
  const double computed = 0.03 / (compliance[1] - compliance[0]);
  // displacements of elements are too stiff: Q2 on 4 x 4 by 1.2e-3
  expect_close("torsion of a square bar, mu J in N m^2", computed, 0.140577 * shear_modulus_Pa * std::pow(side_m, 4), 2e-3);
}

/// M = E I a / l, again between two lengths, for the ends cannot contract. Along the arc of constant length the middle line takes
/// no force to first order.
TEST(BondedPlates, BendABarWithItsFlexuralStiffness) {
  constexpr double side_m = 0.01;
  constexpr double angle_per_m = 0.1;
  constexpr double bulk_modulus_Pa = 2.5e6;
  std::array<double, 2> compliance{};
  const std::array<std::size_t, 2> elements{6, 12};
  for (std::size_t bar = 0; bar < 2; ++bar) {
    const double length_m = 0.5 * side_m * static_cast<double>(elements[bar]);
    Model model(meshes::box({length_m, side_m, side_m}, {elements[bar], 2, 4}), 2,
                gripped_bar(length_m, side_m, bulk_modulus_Pa, {true, true, true}));
    const double angle_rad = angle_per_m * length_m;
    PlateDrive tip{.values = {{}, {.displacement_m = {}, .rotation_rad = {0.0, angle_rad, 0.0}}}, .arc_length_m = length_m};
    const PlateReaction reaction = reaction_of_tip(model, tip);
    compliance[bar] = angle_rad / reaction.moment_N_m[1];
    // the bar's middle sinks below its base as the tip does, by a quarter as far
    const double sag_m = model.displacement_at({0.5 * length_m, 0.5 * side_m, 0.5 * side_m})[2];
    EXPECT_NEAR(sag_m, -angle_rad * length_m / 8.0, 0.05 * angle_rad * length_m / 8.0);
  }
  const double youngs_modulus_Pa = 9.0 * bulk_modulus_Pa * shear_modulus_Pa / (3.0 * bulk_modulus_Pa + shear_modulus_Pa);
  const double computed = 0.03 / (compliance[1] - compliance[0]);
  expect_close("bending of a square bar, E I in N m^2", computed, youngs_modulus_Pa * std::pow(side_m, 4) / 12.0, 1e-4);
}

/// A bonded bar is stiffer than one that may contract and softer than one that may not at all.
TEST(BondedPlates, StretchABarBetweenTheBoundsOfFreeAndHinderedContraction) {
  constexpr double strain = 1e-4;
  Model model(meshes::box({0.01, 0.01, 0.01}, {4, 4, 4}), 2, gripped_bar(0.01, 0.01, 2.5e6, {true, true, true}));
  const PlateReaction reaction =
      reaction_of_tip(model, {.values = {{}, {.displacement_m = {0.01 * strain, 0.0, 0.0}, .rotation_rad = {}}}});
  const double modulus_Pa = reaction.force_N[0] / 1e-4 / strain;
  EXPECT_GT(modulus_Pa, 1.05 * 3.0 * shear_modulus_Pa);
  EXPECT_LT(modulus_Pa, 0.2 * (2.5e6 + 4.0 / 3.0 * shear_modulus_Pa));
}

}  // namespace
}  // namespace menger::fem
