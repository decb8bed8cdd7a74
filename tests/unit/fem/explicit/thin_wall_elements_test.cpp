// Bodies of thin walls in motion: what the elements' kernels do alone is tested in tests/unit/fem/thin_walls.

#include "fem/explicit/thin_wall_elements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "fem/explicit/explicit_contact.h"
#include "fem/explicit/material_damping.h"
#include "fem/thin_walls/thin_wall_kernel.h"
#include "fem/thin_walls/thin_wall_mesh.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

/// A body of two cells with two chambers, as fidelity `standard` cuts it.
meshes::HexahedralMesh two_chambers() {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  options.chambers = meshes::ChamberLayout::per_phase;
  set_elements({}, options);
  return meshes::hollow_polycube({"two", meshes::Polycube::from_digits(2, 1, 1, "12"), 10e-3}, options).mesh;
}

ExplicitBodyOptions walls_of(const meshes::HexahedralMesh& mesh, const ThinWallOptions& walls, double viscosity_Pa_s = 0.0) {
  ExplicitBodyOptions options = silicone_options(mesh, viscosity_Pa_s);
  options.regions[0].material.branches = {{.shear_modulus_Pa = 10e3, .relaxation_time_s = 5e-3}};
  options.elements = walls;
  return options;
}

ThinWallOptions in(Precision precision) { return {.precision = precision, .constants = {}}; }

/// Different pressures in both chambers, weight and ground.
ExplicitOptions all_terms() {
  ExplicitOptions options;
  options.schedules = {{SinePressure{.high_Pa = 4e3, .frequency_Hz = 50.0}, 0.0},
                       {SinePressure{.high_Pa = 6e3, .frequency_Hz = 40.0}, 0.25}};
  options.loads.gravity_m_per_s2 = {0.0, 0.0, -9.81};
  options.loads.ground = RigidGround{.height_m = 0.0,
                                     .stiffness_Pa_per_m = ground_stiffness_Pa_per_m(250e3, 2e-3),
                                     .friction = {.static_coefficient = 0.5, .kinetic_coefficient = 0.3}};
  return options;
}

// The forces are the derivative of the energy with branches and with the pressures on both faces of every wall.
TEST(ThinWallElements, ForcesAreTheDerivativeOfTheEnergies) {
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBody body(mesh, walls_of(mesh, in(Precision::double_precision)));
  const std::vector<double> u = random_numbers(3 * mesh.points.size(), 1e-4, 1);
  const std::vector<double> direction = random_numbers(u.size(), 1.0, 2);
  const std::array pressures{4e3, -1e3};
  BranchNumbers branches = body.elements().branches_at_rest(random_numbers(u.size(), 1e-4, 3));
  const std::unique_ptr<ElementForces> forces = body.elements().make_forces();
  forces->press(pressures);
  forces->place({u.data()}, BlockLoop(1));
  forces->compute({0, forces->batch_count()}, branches, 0.0);
  std::vector<double> force(u.size());
  forces->sum({0, mesh.points.size()}, force.data());
  double power = 0.0;
  for (std::size_t n = 0; n < u.size(); ++n) power += force[n] * direction[n];
  const auto energy = [&](double step) {
    std::vector<double> moved = u;
    for (std::size_t n = 0; n < u.size(); ++n) moved[n] += step * direction[n];
    forces->place({moved.data()}, BlockLoop(1));
    forces->compute({0, forces->batch_count()}, branches, 0.0);
    const PressedVolumes volumes = forces->pressed_volumes();
    double sum = body.elements().strain_energy_J(moved, branches);
    for (std::size_t p = 0; p < 2; ++p) sum -= pressures[p] * (volumes.walls_m3[p] + volumes.chambers_m3[p]);
    return sum;
  };
  constexpr double step = 1e-8;  // 1e-5 of an edge
  EXPECT_NEAR(power, (energy(step) - energy(-step)) / (2.0 * step), 1e-6 * std::abs(power));
}

// The volumes that the walls and the faces of blocks find together are those of the chambers, read off their faces.
TEST(ThinWallElements, PressedVolumesAreThoseOfTheChambers) {
  meshes::HollowBodyOptions shape;
  shape.chambers = meshes::ChamberLayout::per_phase;
  shape.wall_thickness_m = 2e-3;
  set_elements({}, shape);
  const meshes::HexahedralMesh mesh =
      meshes::hollow_polycube({"L", meshes::Polycube::from_digits(2, 2, 1, "1120"), 10e-3}, shape).mesh;
  EXPECT_GT(chamber_faces_of_walls(mesh).size(), 50U);
  const ExplicitBody body(mesh, walls_of(mesh, in(Precision::double_precision)));
  ASSERT_TRUE(body.elements().take_pressure());
  const std::vector<double> u = random_numbers(3 * mesh.points.size(), 2e-4, 5);
  const std::unique_ptr<ElementForces> forces = body.elements().make_forces();
  BranchNumbers branches = body.elements().branches_at_rest(u);
  forces->place({u.data()}, BlockLoop(1));
  forces->compute({0, forces->batch_count()}, branches, 0.0);
  const ExplicitChambers chambers(mesh);
  std::vector<double> positions = body.reference_positions_m();
  positions.push_back(0.0);
  const std::vector<double> before = chambers.volumes_m3(positions);
  for (std::size_t n = 0; n < u.size(); ++n) positions[n] += u[n];
  const std::vector<double> after = chambers.volumes_m3(positions);
  ASSERT_EQ(after.size(), 2U);
  for (std::size_t c = 0; c < 2; ++c)
    EXPECT_NEAR(forces->pressed_volumes().chambers_m3[mesh.chambers[c].plenum], after[c] - before[c], 1e-12 * before[c]);
}

// Elements that follow the nodes give the forces of elements that are placed where these are.
TEST(ThinWallElements, FollowTheirNodes) {
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBody body(mesh, walls_of(mesh, in(Precision::single_precision), 1.0));
  std::vector<double> u(3 * mesh.points.size(), 0.0);
  std::vector<double> v = u;
  BranchNumbers branches = body.elements().branches_at_rest(u);
  const auto forces_of = [&](ElementForces& forces) {
    forces.compute({0, forces.batch_count()}, branches, 0.0);
    std::vector<double> sums(u.size());
    forces.sum({0, mesh.points.size()}, sums.data());
    return sums;
  };
  const std::unique_ptr<ElementForces> followed = body.elements().make_forces();
  followed->place({u.data(), v.data()}, BlockLoop(1));
  const std::vector<double> at_rest = forces_of(*followed);
  const std::vector<double> way = random_numbers(u.size(), 1e-4, 1);
  const std::vector<double> speed = random_numbers(u.size(), 0.1, 2);
  std::copy(way.begin() + 3, way.end(), u.begin() + 3);  // all but the first node
  std::copy(speed.begin() + 3, speed.end(), v.begin() + 3);
  EXPECT_EQ(forces_of(*followed), at_rest);
  followed->follow({0, 100});
  followed->follow({100, mesh.points.size()});
  const std::unique_ptr<ElementForces> placed = body.elements().make_forces();
  placed->place({u.data(), v.data()}, BlockLoop(1));
  EXPECT_EQ(forces_of(*followed), forces_of(*placed));
}

// Energy balance of a driven body in all: errors of second order in the step, for the work of changing pressure on walls, too.
TEST(ThinWallElements, EnergyBalanceCloses) {
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBody body(mesh, walls_of(mesh, in(Precision::double_precision)));
  std::array<double, 2> worst{};
  double wall_pressure_J = 0.0;
  for (std::size_t n = 0; n < 2; ++n) {
    ExplicitOptions options = all_terms();
    options.step_safety = n == 0 ? 0.8 : 0.4;
    ExplicitDynamics dynamics(mesh, body, options);
    for (int k = 1; k <= 20; ++k) {
      ASSERT_EQ(dynamics.advance_to(0.002 * k).status, io::RunStatus::completed);
      const MotionEnergies energies = dynamics.energies();
      worst[n] = std::max(worst[n], std::abs(energies.imbalance_J()) / dynamics.state().turnover_J);
      wall_pressure_J = std::max(wall_pressure_J, std::abs(energies.work.wall_pressure_J) / dynamics.state().turnover_J);
    }
  }
  EXPECT_LT(worst[0], 1e-3);
  EXPECT_LT(worst[1], 0.4 * worst[0]) << "a quarter for half the step";
  EXPECT_GT(wall_pressure_J, 3.0 * worst[0]) << "without it the balance would not close";
}

// A body that stands under its weight has little energy, and rounding must not add to its losses, step by step.
TEST(ThinWallElements, EnergyBalanceOfAStandingBodyClosesInSinglePrecision) {
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBody body(mesh, walls_of(mesh, in(Precision::single_precision)));
  ExplicitOptions options = all_terms();
  options.schedules = {{SinePressure{.high_Pa = 10.0, .frequency_Hz = 5.0}, 0.0},
                       {SinePressure{.high_Pa = 10.0, .frequency_Hz = 5.0}, 0.0}};
  ExplicitDynamics dynamics(mesh, body, options);
  ASSERT_EQ(dynamics.advance_to(0.5).status, io::RunStatus::completed);
  EXPECT_LT(std::abs(dynamics.energies().imbalance_J()), 1e-3 * dynamics.state().turnover_J);
}

TEST(ThinWallElements, SinglePrecisionGoesWhereDoublePrecisionGoes) {
  const meshes::HexahedralMesh mesh = two_chambers();
  std::vector<std::vector<double>> places;
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    const ExplicitBody body(mesh, walls_of(mesh, in(precision), 1.0));
    ExplicitDynamics dynamics(mesh, body, all_terms());
    ASSERT_EQ(dynamics.advance_to(0.02).status, io::RunStatus::completed);
    places.push_back(dynamics.state().displacements_m);
  }
  double largest = 0.0;
  double apart = 0.0;
  for (std::size_t n = 0; n < places[0].size(); ++n) {
    largest = std::max(largest, std::abs(places[1][n]));
    apart = std::max(apart, std::abs(places[0][n] - places[1][n]));
  }
  EXPECT_LT(apart, 1e-4 * largest);  // rounding of 6e-8 in each of some 300 steps, and what friction makes of it
  EXPECT_GT(apart, 0.0);
}

// A body that has walked a hundred metres moves as at the start: single precision sees only how nodes differ.
TEST(ThinWallElements, GoFarWithoutRounding) {
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBody body(mesh, walls_of(mesh, in(Precision::single_precision)));
  const auto force_at = [&](double way) {
    std::vector<double> u = random_numbers(3 * mesh.points.size(), 1e-4, 1);
    for (double& component : u) component += way;
    BranchNumbers branches = body.elements().branches_at_rest(u);
    const std::unique_ptr<ElementForces> forces = body.elements().make_forces();
    forces->place({u.data()}, BlockLoop(1));
    EXPECT_FALSE(forces->compute({0, forces->batch_count()}, branches, 0.0).has_failed);
    std::vector<double> result(u.size());
    forces->sum({0, mesh.points.size()}, result.data());
    result.push_back(body.elements().strain_energy_J(u, branches));
    return result;
  };
  const std::vector<double> here = force_at(0.0);
  const std::vector<double> far = force_at(100.0);
  double largest = 0.0;
  for (std::size_t n = 0; n + 1 < here.size(); ++n) largest = std::max(largest, std::abs(here[n]));
  // A double of 100 m has steps of 1.4e-14 m, 1e-10 of the displacements; single precision rounds them by 6e-8.
  for (std::size_t n = 0; n + 1 < here.size(); ++n) EXPECT_NEAR(far[n], here[n], 1e-5 * largest);
  EXPECT_NEAR(far.back(), here.back(), 1e-5 * here.back());
}

TEST(ThinWallElements, InstructionSetsAgree) {
  const meshes::HexahedralMesh mesh = two_chambers();
  const auto forces_by = [&](std::string_view instruction_set) {
    ThinWallOptions options = in(Precision::double_precision);
    options.instruction_set = instruction_set;
    const ExplicitBody body(mesh, walls_of(mesh, options, 2.0));
    EXPECT_NE(body.elements().text().find(instruction_set), std::string::npos);
    const std::unique_ptr<ElementForces> forces = body.elements().make_forces();
    const std::vector<double> u = random_numbers(3 * mesh.points.size(), 1e-4, 1);
    const std::vector<double> v = random_numbers(u.size(), 1.0, 2);
    BranchNumbers branches = body.elements().branches_at_rest(std::vector<double>(u.size(), 0.0));
    forces->press(std::array{4e3, 1e3});
    forces->place({u.data(), v.data()}, BlockLoop(1));
    ForcesOutcome outcome = forces->compute({0, forces->batch_count()}, branches, 1e-3);
    std::vector<double> result(u.size());
    forces->sum({0, mesh.points.size()}, result.data());
    const PressedVolumes volumes = forces->pressed_volumes();
    result.insert(result.end(), {outcome.dissipated_W, outcome.relaxed_J, volumes.walls_m3[0], volumes.walls_m3[1]});
    return result;
  };
  const std::vector<double> scalar = forces_by("scalar");
  double largest = 0.0;
  for (const double force : scalar) largest = std::max(largest, std::abs(force));
  for (const ThinWallKernels<double>& kernels : available_thin_wall_kernels<double>()) {
    const std::vector<double> other = forces_by(kernels.instruction_set);
    for (std::size_t n = 0; n < scalar.size(); ++n)
      EXPECT_NEAR(other[n], scalar[n], 1e-12 * (n + 4 < scalar.size() ? largest : std::abs(scalar[n])) + 1e-18);
  }
}

TEST(ThinWallElements, ResultsDoNotDependOnThreadsNorOnAnInterruption) {
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBody body(mesh, walls_of(mesh, in(Precision::single_precision), 1.0));
  ExplicitOptions options = all_terms();
  ExplicitDynamics whole(mesh, body, options);
  ASSERT_EQ(whole.advance_to(0.004).status, io::RunStatus::completed);
  const ExplicitState middle = whole.state();
  ASSERT_EQ(whole.advance_to(0.01).status, io::RunStatus::completed);
  for (const int threads : {1, 3}) {
    options.threads = threads;
    ExplicitDynamics again(mesh, body, options);
    again.set_state(middle);
    ASSERT_EQ(again.advance_to(0.01).status, io::RunStatus::completed);
    EXPECT_EQ(again.state().displacements_m, whole.state().displacements_m);
    EXPECT_EQ(again.state().branches, whole.state().branches);
    EXPECT_EQ(again.energies().imbalance_J(), whole.energies().imbalance_J());
  }
}

// A free body keeps momentum and angular momentum, here to the rounding of single precision: forces of an element that are turned
// with it have no resultant but for that.
TEST(ThinWallElements, FreeFlightKeepsMomentum) {
  const meshes::HexahedralMesh mesh = two_chambers();
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    const ExplicitBody body(mesh, walls_of(mesh, in(precision)));
    ExplicitDynamics dynamics(mesh, body, {});
    ExplicitState state = dynamics.state();
    state.at_start_J.reset();
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      const Point& X = mesh.points[n];
      const Point v{0.5 - 60.0 * X[1], -0.2 + 60.0 * X[0], 0.3 + 20.0 * X[0]};
      for (std::size_t i = 0; i < 3; ++i) state.velocities_m_per_s[3 * n + i] = v[i];
    }
    dynamics.set_state(state);
    const Motion before = motion_of(dynamics);
    ASSERT_EQ(dynamics.advance_to(0.02).status, io::RunStatus::completed);
    const Motion after = motion_of(dynamics);
    const double rounding = precision == Precision::single_precision ? 1e-6 : 1e-12;
    EXPECT_LT(norm(difference(after.momentum, before.momentum)), rounding * before.size);
    EXPECT_LT(norm(difference(after.angular, before.angular)), 1e-5 * 0.01 * before.size);  // as without thin walls
  }
}

/// An L of three cells of 10 mm with walls of 2 mm.
meshes::HexahedralMesh hook(Fidelity fidelity) {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  set_elements({.fidelity = fidelity}, options);
  return meshes::hollow_polycube({"l", meshes::Polycube::from_digits(2, 1, 2, "1110"), 10e-3}, options).mesh;
}

// Nothing damps this body, which rings at half a metre in a second. Steps are the default ones. Its energy changes by
// less than a hundredth; in a second, steps of 0.9 of the stable one would let it grow by a quarter (draft).
TEST(ThinWallElements, DefaultStepsKeepTheEnergyOfAnUndampedBody) {
  for (const Fidelity fidelity : {Fidelity::draft, Fidelity::standard}) {
    const meshes::HexahedralMesh mesh = hook(fidelity);
    ExplicitBodyOptions body_options = silicone_options(mesh);
    body_options.elements = ThinWallOptions{.precision = Precision::single_precision, .constants = ThinWallConstants{}};
    const ExplicitBody body(mesh, body_options);
    ExplicitDynamics dynamics(mesh, body, {});
    ExplicitState state = dynamics.state();
    state.at_start_J.reset();
    constexpr double speed = 0.5;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      const Point& X = mesh.points[n];
      const Point v{std::sin(400.0 * X[2]), std::cos(300.0 * X[0]), std::sin(350.0 * X[0] + 200.0 * X[1])};
      for (std::size_t i = 0; i < 3; ++i) state.velocities_m_per_s[3 * n + i] = speed * v[i];
    }
    dynamics.set_state(state);
    const double energy = dynamics.energies().kinetic_J;
    for (int n = 1; n <= 6; ++n) {
      ASSERT_EQ(dynamics.advance_to(0.05 * n).status, io::RunStatus::completed);
      EXPECT_LT(std::abs(dynamics.energies().imbalance_J()), 0.01 * energy) << 0.05 * n << " s";
    }
  }
}

// A vacuum draws the thin walls of a cube of 20 mm together until they carry each other; then the body is at rest. (From 8 kPa on
// the faces of 5 mm fold so sharply that contact loses them, which ends the run as diverged.)
TEST(ThinWallElements, WallsThatTouchCarryEachOther) {
  meshes::HollowBodyOptions hollow;
  hollow.wall_thickness_m = 2e-3;
  set_elements({}, hollow);
  const meshes::HexahedralMesh mesh = meshes::hollow_polycube(meshes::hollow_cube_design(20e-3), hollow).mesh;
  ExplicitBodyOptions body_options = silicone_options(mesh, 2.0);
  body_options.elements = in(Precision::single_precision);
  body_options.supports = {{meshes::label_index(mesh, "ground"), {false, false, true}}};
  body_options.point_supports = {{{0.0, 0.0, 0.0}, {true, true, false}}, {{20e-3, 0.0, 0.0}, {false, true, false}}};
  const ExplicitBody body(mesh, body_options);
  ExplicitOptions options;
  options.loads.mass_damping_per_s = 100.0;
  options.loads.gravity_m_per_s2 = {1.0, 0.6, -9.81};
  options.schedules = {{ConstantPressure{-6.5e3}, 0.1}};
  ExplicitDynamics dynamics(mesh, body, options);
  const double volume = dynamics.chamber_volumes_m3()[0];
  ASSERT_EQ(dynamics.advance_to(0.3).status, io::RunStatus::completed) << dynamics.advance_to(0.3).reason;
  EXPECT_GT(dynamics.self_touches().size(), 8U);
  for (const SelfTouch& touch : dynamics.self_touches()) EXPECT_LT(norm(touch.behind_m), 0.1 * body.smallest_edge_m());
  const double left = dynamics.chamber_volumes_m3()[0] / volume;
  EXPECT_GT(left, 0.1);
  EXPECT_LT(left, 0.3);
  const MotionEnergies energies = dynamics.energies();
  EXPECT_LT(energies.kinetic_J, 1e-5 * std::abs(energies.work.pressure_J));
  EXPECT_LT(std::abs(energies.imbalance_J()), 1e-4 * std::abs(energies.work.pressure_J));
}

// Modules of an aggregate that are pressed into each other along an edge by 6 kPa, by less than a fiftieth of a wall. Their light
// nodes carry no springs that would shorten steps by a third, as those of their areas do.
TEST(ThinWallElements, TouchesShortenTheStepsOfAggregatesLittle) {
  meshes::HollowBodyOptions shape;
  shape.level = 2;
  shape.wall_thickness_m = 2e-3;
  set_elements({.fidelity = Fidelity::draft}, shape);
  const meshes::HollowBody hollow = meshes::hollow_polycube({"L", meshes::Polycube::from_digits(2, 2, 1, "1110"), 0.01}, shape);
  ExplicitBodyOptions body_options = silicone_options(hollow.mesh, 0.0);
  for (ExplicitRegion& region : body_options.regions) region.material.law = materials::NeoHookean{86.7e3};
  body_options.elements = ThinWallOptions{};
  const ExplicitBody body(hollow.mesh, body_options);
  ExplicitOptions options;
  options.schedules.assign(hollow.mesh.plenum_names.size(), {ConstantPressure{6e3}, 0.01});
  ExplicitDynamics dynamics(hollow.mesh, body, options);
  const std::unique_ptr<ElementForces> forces = body.elements().make_forces();
  const BlockLoop loop(1);
  EigenvalueEstimate estimate(body, loop, *forces);
  std::size_t most = 0;
  double deepest = 0.0;
  double worst = 1.0;
  for (int n = 1; n <= 40; ++n) {
    ASSERT_EQ(dynamics.advance_to(1e-3 * n).status, io::RunStatus::completed);
    const std::vector<SelfTouch> touches = dynamics.self_touches();
    if (touches.empty()) continue;
    most = std::max(most, touches.size());
    for (const SelfTouch& touch : touches) deepest = std::max(deepest, norm(touch.behind_m));
    const ExplicitState& state = dynamics.state();
    BranchNumbers branches = state.branches->numbers;
    const auto step_with = [&](std::span<const SelfTouch> some) {
      return stable_step_s(estimate.at(state.displacements_m, branches, *forces, {}, some));
    };
    worst = std::min(worst, step_with(touches) / step_with({}));
  }
  EXPECT_GE(most, 5U);
  EXPECT_GT(worst, 0.75);
  EXPECT_LT(deepest, 0.02 * shape.wall_thickness_m);
}

TEST(ThinWallElements, ACrushedWallIsReported) {
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBody body(mesh, walls_of(mesh, in(Precision::single_precision)));
  std::vector<double> u(3 * mesh.points.size(), 0.0);
  EXPECT_FALSE(body.elements().failed_element(u));
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    if (mesh.points[n][2] > 9e-3) u[3 * n + 2] = -1.5e-3;  // a quarter of the top wall's thickness is left
  ASSERT_TRUE(body.elements().failed_element(u));
  EXPECT_TRUE(body.elements().failed_element(u)->is_finite);
  EXPECT_NEAR(body.elements().failed_element(u)->position_m[2], 8e-3, 1e-9);
  u[0] = std::nan("");
  ASSERT_TRUE(body.elements().failed_element(u));
  BranchNumbers branches = body.elements().branches_at_rest(std::vector<double>(u.size(), 0.0));
  const std::unique_ptr<ElementForces> forces = body.elements().make_forces();
  forces->place({u.data()}, BlockLoop(1));
  EXPECT_TRUE(forces->compute({0, forces->batch_count()}, branches, 0.0).has_failed);
}

// What the elements are for: steps of 60 us and more where cells are 10 mm and walls 2 mm, and of 80 us for drafts.
TEST(ThinWallElements, HaveLongSteps) {
  for (const auto& [fidelity, least_s] : {std::pair(Fidelity::draft, 80e-6), std::pair(Fidelity::standard, 60e-6)}) {
    const meshes::HexahedralMesh mesh = hook(fidelity);
    ExplicitBodyOptions body_options = silicone_options(mesh);
    body_options.regions[0].material.law = materials::NeoHookean{86.7e3};
    body_options.elements = ThinWallOptions{.precision = Precision::single_precision, .constants = ThinWallConstants{}};
    const ExplicitBody body(mesh, body_options);
    const std::unique_ptr<ElementForces> forces = body.elements().make_forces();
    const BlockLoop loop(1);
    BranchNumbers none = body.elements().branches_at_rest(std::vector<double>(3 * mesh.points.size(), 0.0));
    const std::vector<double> rest(3 * mesh.points.size(), 0.0);
    EXPECT_GT(stable_step_s(EigenvalueEstimate(body, loop, *forces).at(rest, none, *forces)), least_s);
  }
}

}  // namespace
}  // namespace menger::fem
