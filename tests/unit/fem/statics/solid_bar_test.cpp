#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fem/statics/inflation_path.h"
#include "meshes/hexahedra/verification_shapes.h"

namespace menger::fem {
namespace {

constexpr double edge_m = 0.01;
constexpr double shear_modulus_Pa = 86677.0;
constexpr double poissons_ratio = 0.49;
constexpr double bulk_modulus_Pa = shear_modulus_Pa * 2.0 * (1.0 + poissons_ratio) / (3.0 * (1.0 - 2.0 * poissons_ratio));
constexpr double youngs_modulus_Pa = 2.0 * shear_modulus_Pa * (1.0 + poissons_ratio);

/// What a solid bar responds to a stretch between two plates.
struct BarResponse {
  double modulus_Pa = 0.0;   ///< force by the area at rest by the strain
  double contraction = 0.0;  ///< part of its width that the middle section loses, mean over a side, by the strain
};

/// A neo-Hookean bar of some cells of 1 cm along x in quadratic elements of 2.5 mm, stretched by a strain. @param slides whether
/// the plates let its ends contract
BarResponse stretched(int cells, bool slides, double strain) {
  const double length_m = cells * edge_m;
  constexpr std::size_t per_cell = 4;
  const Space space =
      make_space(meshes::box({length_m, edge_m, edge_m}, {per_cell * static_cast<std::size_t>(cells), per_cell, per_cell}), 2, 0,
                 MPI_COMM_SELF);
  Body body;
  body.regions = {{materials::NeoHookean{shear_modulus_Pa}, materials::SimoTaylorVolume{bulk_modulus_Pa}, 0.0}};
  const std::array<bool, 3> held{true, !slides, !slides};
  const Point centre{0.0, 0.5 * edge_m, 0.5 * edge_m};
  body.plates = {{.faces = {.plane = AxisPlane{0, 0.0}}, .centre = centre, .held = held},
                 {.faces = {.plane = AxisPlane{0, length_m}}, .centre = sum(centre, {length_m, 0.0, 0.0}), .held = held}};
  // what sliding plates leave of the rigid motions
  if (slides) body.point_supports = {{{0.0, 0.0, 0.0}, {false, true, true}}, {{0.0, edge_m, 0.0}, {false, false, true}}};
  Equilibrium equilibrium(space, body, EquilibriumOptions{});
  PathDrives drives;
  drives.plates = {{{{}, {}}}, {{{}, {{strain * length_m, 0.0, 0.0}, {}}}}};
  BodyState last;
  const PathReport report = follow_path(equilibrium, drives, PathOptions{},
                                        [&](const PathPoint&, const BodyState& state, const PathRestart&) { last = state; });
  EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
  BarResponse response;
  response.modulus_Pa = report.points.back().plates[1].force_N[0] / (edge_m * edge_m * strain);
  double narrowing_m = 0.0;
  int count = 0;
  for (std::size_t n = 0; n < space.positions.size(); ++n) {
    const Point& X = space.positions[n];
    const bool is_in_the_middle = std::abs(X[0] - 0.5 * length_m) < 1e-9;
    const bool is_on_a_side = X[1] < 1e-9 || X[1] > edge_m - 1e-9;
    if (!is_in_the_middle || !is_on_a_side) continue;
    narrowing_m += (X[1] < 1e-9 ? 1.0 : -1.0) * last.displacements_m[3 * n + 1];
    ++count;
  }
  response.contraction = 2.0 * narrowing_m / count / (edge_m * strain);
  return response;
}

void record(const std::string& name, const BarResponse& response) {
  testing::Test::RecordProperty(name + "_modulus_by_E", std::to_string(response.modulus_Pa / youngs_modulus_Pa));
  testing::Test::RecordProperty(name + "_contraction", std::to_string(response.contraction));
}

// A homogeneous state, which every mesh represents: what is left is the curvature of the law over a strain of 1e-4.
TEST(SolidBar, BetweenSlidingPlatesHasTheModuliOfTheMaterial) {
  for (const int cells : {3, 6}) {
    const BarResponse response = stretched(cells, true, 1e-4);
    record("sliding_" + std::to_string(cells), response);
    EXPECT_NEAR(response.modulus_Pa / youngs_modulus_Pa, 1.0, 5e-4) << cells;
    EXPECT_NEAR(response.contraction, poissons_ratio, 5e-4) << cells;
  }
}

// Neo-Hookean: lateral stretch m of the axial one l from mu (m^2 - I1 / 3) J^(-5/3) + kappa/2 (J - 1 / J) = 0, J = l m^2, I1 =
// l^2 + 2 m^2, solved by bisection.
TEST(SolidBar, BetweenSlidingPlatesFollowsTheLawAtLargeStrain) {
  const double l = 1.2;
  const auto lateral_stress = [&](double m) {
    const double J = l * m * m;
    return shear_modulus_Pa * std::pow(J, -5.0 / 3.0) * (m * m - (l * l + 2.0 * m * m) / 3.0) +
           0.5 * bulk_modulus_Pa * (J - 1.0 / J);
  };
  double low = 0.8;
  double high = 1.0;
  for (int step = 0; step < 60; ++step) (lateral_stress(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
  const BarResponse response = stretched(3, true, l - 1.0);
  record("sliding_3_at_20_percent", response);
  EXPECT_NEAR(response.contraction, (1.0 - low) / (l - 1.0), 1e-6);
}

// What bonded ends add to the stiffness is theirs alone (Saint-Venant): the length that the bar seems to have lost, L (1 - E /
// modulus), is that of both bars. In the middle the stress is uniaxial and the same as everywhere: it contracts by nu times the
// force by area and E. Both hold up to what is left of the ends' disturbance one and a half widths away from them, some
// thousandths.
TEST(SolidBar, BetweenBondedPlatesIsStifferByItsEndsAlone) {
  const BarResponse three = stretched(3, false, 1e-4);
  const BarResponse six = stretched(6, false, 1e-4);
  record("bonded_3", three);
  record("bonded_6", six);
  const double lost_by_three = 3.0 * (1.0 - youngs_modulus_Pa / three.modulus_Pa);
  const double lost_by_six = 6.0 * (1.0 - youngs_modulus_Pa / six.modulus_Pa);
  EXPECT_GT(lost_by_three, 0.1);
  EXPECT_NEAR(lost_by_six / lost_by_three, 1.0, 0.01);
  for (const BarResponse& response : {three, six})
    EXPECT_NEAR(response.contraction / (poissons_ratio * response.modulus_Pa / youngs_modulus_Pa), 1.0, 0.003);
}

// The same order at large strain, where law and geometry take some of it back.
TEST(SolidBar, BetweenBondedPlatesStaysStifferAtLargeStrain) {
  constexpr double strain = 0.2;
  const BarResponse sliding = stretched(3, true, strain);
  const BarResponse three = stretched(3, false, strain);
  const BarResponse six = stretched(6, false, strain);
  record("bonded_3_at_20_percent", three);
  record("bonded_6_at_20_percent", six);
  EXPECT_GT(three.modulus_Pa, six.modulus_Pa);
  EXPECT_GT(six.modulus_Pa, sliding.modulus_Pa);
  EXPECT_GT(three.contraction, six.contraction);
  EXPECT_GT(six.contraction, sliding.contraction);
}

}  // namespace
}  // namespace menger::fem
