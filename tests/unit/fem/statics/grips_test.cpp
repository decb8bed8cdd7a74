#include "fem/statics/grips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fem/statics/inflation_path.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/fem/statics/body_samples.h"

namespace menger::fem {
namespace {

constexpr Point bar_size{0.03, 0.01, 0.01};

/// A solid bar along x with a plate bonded to either end, centres in the middle of the ends.
Body gripped_bar() {
  Body body;
  body.regions = {{materials::MooneyRivlin{40e3, 5e3}, materials::SimoTaylorVolume{2.5e6}, 1000.0}};
  body.plates = {{.faces = {.label = x_min}, .centre = {0.0, 0.005, 0.005}},
                 {.faces = {.plane = AxisPlane{0, 0.03}}, .centre = {0.03, 0.005, 0.005}}};
  return body;
}

struct Reached {
  PathReport report;
  BodyState state;
};

Reached follow(Equilibrium& equilibrium, const PathDrives& drives, const PathOptions& options = {}) {
  Reached reached;
  reached.report = follow_path(equilibrium, drives, options,
                               [&](const PathPoint&, const BodyState& state, const PathRestart&) { reached.state = state; });
  EXPECT_EQ(reached.report.status, io::RunStatus::completed) << reached.report.reason;
  return reached;
}

/// The tip plate of a bar moved from rest while the base plate stays.
Reached move_tip(Equilibrium& equilibrium, const PlateMotion& motion) {
  return follow(equilibrium, {.plates = {{}, {.values = {{}, motion}}}});
}

void expect_near_point(const Point& computed, const Point& expected, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(computed[i], expected[i], tolerance) << "component " << i;
}

TEST(PlateMotion, TurnsPointsAboutTheCentreByTheRightHandRule) {
  const Plate plate{.centre = {1.0, 2.0, 3.0}};
  const PlateMotion motion{.displacement_m = {0.5, 0.0, 0.0}, .rotation_rad = {0.0, 0.0, 0.5 * std::numbers::pi}};
  // (1, 0, 0) from the centre goes to (0, 1, 0)
  expect_near_point(plate_displacement(plate, motion, {2.0, 2.0, 3.0}), {0.5 - 1.0, 1.0, 0.0}, 1e-15);
  expect_near_point(plate_displacement(plate, motion, plate.centre), {0.5, 0.0, 0.0}, 0.0);
}

TEST(PlateMotion, IsLinearBetweenKnotsAndStaysBeyondThem) {
  const PlateDrive drive{.values = {{}, {{2.0, 0.0, 0.0}, {0.0, 0.4, 0.0}}, {{4.0, 0.0, 2.0}, {}}}};
  EXPECT_EQ(motion_at(drive, -1.0), PlateMotion{});
  EXPECT_EQ(motion_at(drive, 1.0), drive.values[1]);
  expect_near_point(motion_at(drive, 1.5).displacement_m, {3.0, 0.0, 1.0}, 1e-15);
  expect_near_point(motion_at(drive, 1.5).rotation_rad, {0.0, 0.2, 0.0}, 1e-15);
  EXPECT_EQ(motion_at(drive, 7.0), drive.values[2]);
  EXPECT_EQ(motion_at({}, 1.0), PlateMotion{});
}

TEST(PlateMotion, FollowsTheArcOfABarOfConstantLength) {
  const double length = 0.03;
  // the tip of a bar from the origin along x whose direction turns evenly by a: integral of (cos, -sin) over its length
  for (const double angle : {1e-7, 0.9e-4, 1.1e-4, 0.5, -2.0}) {
    const PlateDrive drive{.values = {{}, {{}, {0.0, angle, 0.0}}}, .arc_length_m = length};
    Point tip{};
    constexpr int parts = 2000;
    for (int n = 0; n < parts; ++n) {
      const double turned = angle * (n + 0.5) / parts;
      tip = sum(tip, scaled(length / parts, {std::cos(turned), 0.0, -std::sin(turned)}));
    }
    const Point moved = motion_at(drive, 1.0).displacement_m;
    // the rule of midpoints is off by angle^2 / 24 parts^2, and summing by rounding
    expect_near_point(moved, difference(tip, {length, 0.0, 0.0}), length * (1e-13 + 5e-8 * angle * angle));
  }
}

TEST(FaceMean, IsExactForLinearFieldsAndKnowsTheArea) {
  for (const int degree : {1, 2}) {
    const Space space = make_space(meshes::box(bar_size, {3, 2, 2}), degree, 0, MPI_COMM_SELF);
    const FaceMean tip({.plane = AxisPlane{0, 0.03}}, space);
    EXPECT_NEAR(tip.area_m2(), 1e-4, 1e-18);
    expect_near_point(tip.position_m(), {0.03, 0.005, 0.005}, 1e-16);
    std::vector<double> displacements;
    for (const Point& x : space.positions) displacements.insert(displacements.end(), {x[1], x[0] + 2.0 * x[2], 1.0});
    expect_near_point(tip.displacement_m(displacements), {0.005, 0.04, 1.0}, 1e-15);
    EXPECT_EQ(FaceMean({.plane = AxisPlane{0, 0.02}}, space).area_m2(), 0.0);
  }
}

TEST(Plates, CarryTheirNodesExactly) {
  const Space space = make_space(meshes::box(bar_size, {4, 2, 2}), 2, 0, MPI_COMM_SELF);
  const Body body = gripped_bar();
  Equilibrium equilibrium(space, body, {});
  const PlateMotion motion{.displacement_m = {0.003, -0.001, 0.002}, .rotation_rad = {0.3, 0.2, -0.1}};
  const Reached reached = move_tip(equilibrium, motion);
  for (std::size_t a = 0; a < space.positions.size(); ++a) {
    const bool on_tip = space.positions[a][0] > 0.03 - 1e-12;
    if (!on_tip && space.positions[a][0] > 1e-12) continue;
    const Point expected = on_tip ? plate_displacement(body.plates[1], motion, space.positions[a]) : Point{};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(reached.state.displacements_m[3 * a + i], expected[i]);
  }
}

// Both plates turn by a right angle as one: a rigid motion of the body, in few steps, without energy.
TEST(Plates, ThatMoveAsOneMoveTheBodyRigidly) {
  const Space space = make_space(meshes::box(bar_size, {3, 1, 1}), 2, 0, MPI_COMM_SELF);
  Body body = gripped_bar();
  body.plates[0].centre = body.plates[1].centre;
  Equilibrium equilibrium(space, body, {});
  const PlateMotion motion{.displacement_m = {0.01, 0.02, 0.0}, .rotation_rad = {0.0, 0.5 * std::numbers::pi, 0.0}};
  const PlateDrive drive{.values = {{}, motion}};
  const Reached reached = follow(equilibrium, {.plates = {drive, drive}});
  const PathPoint& last = reached.report.points.back();
  // energy and forces of unit strain: modulus times volume and times area
  EXPECT_LT(last.strain_energy_J, 1e-12 * 90e3 * 3e-6);
  EXPECT_LT(norm(last.plates[1].force_N), 1e-6 * 90e3 * 1e-4);
  for (std::size_t a = 0; a < space.positions.size(); ++a) {
    const Point expected = plate_displacement(body.plates[1], motion, space.positions[a]);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(reached.state.displacements_m[3 * a + i], expected[i], 1e-9);
  }
}

/// The energy at a motion of the tip, reached from a state near it.
double energy_J(Equilibrium& equilibrium, BodyState state, const PlateMotion& motion) {
  equilibrium.move_plates(std::vector<PlateMotion>{{}, motion});
  const EquilibriumReport report = equilibrium.solve(state, {}, 1.0);
  EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
  return report.totals.strain_energy_J;
}

// Force and moment are the derivatives of the energy by the plate's motion, here at a finite stretch with a turn. The moment is
// that by a further turn about an axis through the present centre, so the turn here is about that axis alone.
TEST(Plates, ReactWithTheDerivativeOfTheEnergy) {
  const Space space = make_space(meshes::box(bar_size, {4, 2, 2}), 2, 0, MPI_COMM_SELF);
  const Body body = gripped_bar();
  EquilibriumOptions options;
  options.relative_force_tolerance = 1e-10;
  Equilibrium equilibrium(space, body, options);
  const PlateMotion motion{.displacement_m = {0.006, 0.0, 0.002}, .rotation_rad = {0.0, 0.3, 0.0}};
  const Reached reached = move_tip(equilibrium, motion);
  const PlateReaction& reaction = reached.report.points.back().plates[1];
  const auto derivative = [&](auto member, std::size_t component, double step) {
    PlateMotion ahead = motion;
    PlateMotion behind = motion;
    (ahead.*member)[component] += step;
    (behind.*member)[component] -= step;
    return (energy_J(equilibrium, reached.state, ahead) - energy_J(equilibrium, reached.state, behind)) / (2.0 * step);
  };
  // central differences at 1e-4 of the length are off by its square
  constexpr double step_m = 3e-6;
  const double scale_N = norm(reaction.force_N);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(reaction.force_N[i], derivative(&PlateMotion::displacement_m, i, step_m), 1e-6 * scale_N) << i;
  EXPECT_NEAR(reaction.moment_N_m[1], derivative(&PlateMotion::rotation_rad, 1, 3e-4), 1e-6 * norm(reaction.moment_N_m));
  const PlateReaction& base = reached.report.points.back().plates[0];
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(base.force_N[i] + reaction.force_N[i], 0.0, 1e-9 * scale_N) << i;
}

TEST(Plates, CarryTheWeightAndThePullOnTheOtherEnd) {
  const Space space = make_space(meshes::box(bar_size, {4, 2, 2}), 2, 0, MPI_COMM_SELF);
  Body body = gripped_bar();
  body.plates.pop_back();
  body.gravity_m_per_s2 = {0.0, 0.0, -9.80665};
  body.tractions = {{x_max, {200.0, 0.0, 0.0}}};
  Equilibrium equilibrium(space, body, {});
  const Reached reached = follow(equilibrium, {});
  const PathPoint& last = reached.report.points.back();
  const double weight_N = 1000.0 * 3e-6 * 9.80665;
  const double pull_N = 200.0 * 1e-4;
  expect_near_point(last.plates[0].force_N, {-pull_N, 0.0, weight_N}, 1e-6 * pull_N);
  // the moment balances them in the bent shape: lever of the weight about 15 mm, so m g l / 2 about -y within the sagging
  EXPECT_NEAR(last.plates[0].moment_N_m[1], -weight_N * 0.015, 0.1 * weight_N * 0.015);
  EXPECT_NEAR(last.plates[0].moment_N_m[2], 0.0, 1e-6 * weight_N * 0.015);
}

/// A hollow cube of 10 mm with walls of 2 mm between two plates.
Body gripped_cube() {
  Body body = gripped_bar();
  body.plates[1].faces.plane->position_m = 0.01;
  body.plates[1].centre = {0.01, 0.005, 0.005};
  body.chambers = {{{chamber}, 0}};
  body.plenum_count = 1;
  return body;
}

meshes::HexahedralMesh hollow_cube() {
  const std::vector<double> lines{0.0, 0.002, 0.005, 0.008, 0.01};
  return box_of_cells({lines, lines, lines}, [&](const std::array<std::size_t, 3>& cell) {
    return std::all_of(cell.begin(), cell.end(), [](std::size_t place) { return place == 1 || place == 2; });
  });
}

// Under pressure the force is the derivative of E - p V, and a closed chamber pushes nothing away.
TEST(Plates, HoldAPressurisedBodyWithTheDerivativeOfItsPotential) {
  const Space space = make_space(hollow_cube(), 2, 0, MPI_COMM_SELF);
  const Body body = gripped_cube();
  EquilibriumOptions options;
  options.relative_force_tolerance = 1e-10;
  Equilibrium equilibrium(space, body, options);
  constexpr double pressure_Pa = 3e3;
  constexpr double displacement_m = 0.001;
  const PathDrives drives{.plena = {{.values = {0.0, pressure_Pa}}},
                          .plates = {{}, {.values = {{}, {{displacement_m, 0.0, 0.0}, {}}}}}};
  const Reached reached = follow(equilibrium, drives);
  const auto potential_J = [&](double at_m) {
    BodyState state = reached.state;
    equilibrium.move_plates(std::vector<PlateMotion>{{}, {{at_m, 0.0, 0.0}, {}}});
    const PlenumControl control = PressureControl{pressure_Pa};
    const EquilibriumReport report = equilibrium.solve(state, {&control, 1}, 1.0);
    EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
    return report.totals.strain_energy_J - pressure_Pa * report.plenum_volumes_m3[0];
  };
  constexpr double step_m = 1e-6;
  const double derivative_N = (potential_J(displacement_m + step_m) - potential_J(displacement_m - step_m)) / (2.0 * step_m);
  const PathPoint& last = reached.report.points.back();
  EXPECT_NEAR(last.plates[1].force_N[0], derivative_N, 1e-6 * std::abs(derivative_N));
  expect_near_point(sum(last.plates[0].force_N, last.plates[1].force_N), {}, 1e-8 * std::abs(derivative_N));
}

// Moving plates and a given volume of air together: the first step of a plate does not know what it does to the volume.
TEST(Plates, MoveUnderControlByVolume) {
  const Space space = make_space(hollow_cube(), 1, 0, MPI_COMM_SELF);
  const Body body = gripped_cube();
  Equilibrium equilibrium(space, body, {});
  const PathDrives drives{.plena = {{.kind = DriveKind::volume, .values = {1.0, 1.1}}},
                          .plates = {{}, {.values = {{}, {{0.001, 0.0, 0.0}, {}}}}}};
  const PathPoint last = follow(equilibrium, drives).report.points.back();
  EXPECT_NEAR(last.plenum_volumes_m3[0], 1.1 * 2.16e-7, 1e-9 * 2.16e-7);
}

TEST(Plates, ReachLargeMotionsInFewSteps) {
  const Space space = make_space(meshes::box(bar_size, {4, 2, 2}), 2, 0, MPI_COMM_SELF);
  const Body body = gripped_bar();
  Equilibrium equilibrium(space, body, {});
  const std::vector<PlateMotion> motions{{{0.009, 0.0, 0.0}, {}}, {{}, {1.2, 0.0, 0.0}}, {{0.0, 0.0, 0.008}, {}}};
  for (const PlateMotion& motion : motions) {
    const Reached reached = move_tip(equilibrium, motion);
    EXPECT_EQ(reached.report.rejected_steps, 0);
    EXPECT_LE(reached.report.points.size(), 6U);
    EXPECT_LE(reached.report.iterations, 40);
  }
}

TEST(Plates, GoOnWhereAPathWasInterrupted) {
  const Space space = make_space(meshes::box(bar_size, {3, 1, 1}), 1, 0, MPI_COMM_SELF);
  const Body body = gripped_bar();
  Equilibrium equilibrium(space, body, {});
  const PathDrives drives{.plates = {{}, {.values = {{}, {{0.003, 0.0, 0.0}, {0.5, 0.0, 0.0}}}}}};
  std::vector<PathRestart> restarts;
  const auto keep = [&](const PathPoint&, const BodyState&, const PathRestart& restart) { restarts.push_back(restart); };
  const PathReport whole = follow_path(equilibrium, drives, {}, keep);
  ASSERT_GE(restarts.size(), 3U);
  const PathReport rest = follow_path(equilibrium, drives, {}, {}, nullptr, &restarts[1]);
  ASSERT_EQ(rest.points.size(), whole.points.size());
  EXPECT_EQ(rest.points.back().strain_energy_J, whole.points.back().strain_energy_J);
  EXPECT_EQ(rest.points.back().plates, whole.points.back().plates);
}

}  // namespace
}  // namespace menger::fem
