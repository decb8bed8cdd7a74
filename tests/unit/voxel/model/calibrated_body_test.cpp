// A body of hollow cells in the engine: the limit of solid voxels, its pressures, and what it is refused for.

#include "voxel/model/calibrated_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "voxel/engine/voxel_classes.h"
#include "voxel/lanes/simulation.h"
#include "voxel/model/surrogate_beams.h"

namespace menger::voxel {
namespace {

constexpr double edge = 0.01;

/// Walls so thick that hardly any air is left, with the stiffness and the linear drive of solid voxels.
CalibratedBody solid_body(double modulus_Pa, double density_kg_m3, double amplitude) {
  CalibratedBody body;
  SurrogateParameters& p = body.parameters;
  p.silicone = "test";
  p.cell_edge_m = edge;
  p.wall_thickness_m = 0.49999 * edge;
  p.validity = {.smallest_strain = -1.0, .largest_strain = 1.0, .longest_body_cells = 9, .longest_aggregate_modules = 9};
  p.validity.set_pressures(-1e4, 1e4);
  p.density_kg_m3 = density_kg_m3;
  p.axial_Pa.fill(modulus_Pa);
  p.bending_Pa.fill(modulus_Pa);
  p.torsion_Pa.fill(modulus_Pa);
  p.extension.fill({.slope_per_Pa = amplitude / 1e3});
  p.ground_stiffness_N_per_m = 2.0 * modulus_Pa * edge;
  body.pressure_Pa = {-1e3, 1e3};
  return body;
}

/// Classes that differ, beams that shear, a law that bends, coupling, two chambers.
CalibratedBody example_body() {
  CalibratedBody body = solid_body(3e4, 1000.0, 0.03);
  SurrogateParameters& p = body.parameters;
  p.wall_thickness_m = 0.002;
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    const auto k = static_cast<double>(c);
    p.axial_Pa[c] = 2e4 + 5e3 * k;
    p.bending_Pa[c] = 4e4 + 3e3 * k;
    p.torsion_Pa[c] = 1e4 + 2e3 * k;
    p.shear_compliance_per_Pa[c] = (5.0 - 0.7 * k) * 1e-5;
    p.extension[c] = {(4.0 - 0.5 * k) * 1e-5, 1e-4, -5e-5};
    p.bulge[c] = {1e-5 * k, 1e-4, 0.0};
  }
  p.bulge_peak_ratio.fill(2.0);
  p.joint = {.axial = 1.2, .bending = 1.5, .torsion = 0.8};
  p.lateral_coupling = 0.5;
  p.bond_damping_ratio = 0.5;
  p.ground_stiffness_N_per_m = 400.0;
  return body;
}

Physics driven_by(const CalibratedBody& body, ActuationMode mode = ActuationMode::in_phase) {
  Physics physics;
  physics.surrogate = body;
  physics.actuation.mode = mode;
  physics.actuation.frequency_Hz = 5.0;
  return physics;
}

Physics floating(Physics physics) {
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.damping_ratios.global = 0.0;
  physics.collisions.exclusion_depth.reset();
  return physics;
}

const meshes::Polycube standing_quadruped = meshes::Polycube::from_digits(3, 3, 2, "101000101111111111");

TEST(CalibratedBody, OfSolidCellsMovesLikeSolidVoxels) {
  CalibratedBody body = solid_body(2e4, 500.0, 0.1);
  body.chambers = meshes::ChamberLayout::per_phase;
  body.parameters.chambers = meshes::ChamberLayout::per_phase;
  const meshes::Polycube pair = meshes::Polycube::from_digits(2, 1, 1, "12");
  // Off the ground, on which solid voxels stand otherwise.
  Physics calibrated = floating(driven_by(body, ActuationMode::antiphase));
  Physics solid = calibrated;
  solid.surrogate.reset();
  for (VoxelMaterial& material : solid.materials) {
    material.youngs_modulus_Pa = 2e4;
    material.density_kg_m3 = 500.0;
  }
  solid.actuation.amplitude = 0.1;
  for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
    calibrated.integration.damping = solid.integration.damping = mode;
    Simulation hollow(pair, edge, calibrated);
    Simulation plain(pair, edge, solid);
    // The air left in the cells makes them lighter by a quarter of 4e-10.
    EXPECT_NEAR(hollow.time_step_s() / plain.time_step_s(), 1.0, 1e-8);
    ASSERT_EQ(hollow.advance(1000), io::RunStatus::completed);
    ASSERT_EQ(plain.advance(1000), io::RunStatus::completed);
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(hollow.position_m(i)[axis], plain.position_m(i)[axis], 1e-7 * edge) << i << " " << axis;
    }
    EXPECT_NEAR(hollow.frame().size_m[1], plain.frame().size_m[1], 1e-9 * edge);
  }
}

TEST(CalibratedBody, OfSolidVoxelsHasTheirClasses) {
  Physics physics = driven_by(solid_body(2e4, 500.0, 0.1));
  physics.materials[1].kinetic_friction = 0.3;
  Physics solid = physics;
  for (VoxelMaterial& material : solid.materials) {
    material.youngs_modulus_Pa = 2e4;
    material.density_kg_m3 = 500.0;
  }
  HollowVoxels voxels;
  voxels.body = meshes::Polycube::from_digits(3, 1, 1, "121");
  voxels.wall_class.assign(3, {walls::closed, walls::three, walls::three});
  voxels.chamber.assign(3, 0);
  voxels.chamber_count = 1;
  voxels.wall_volume_m3.assign(3, edge * edge * edge);
  voxels.inertia_factor.assign(3, 1.0);
  const Lattice lattice(voxels.body);
  const BodyClasses a = calibrated_classes(lattice, voxels, physics, {false, false, true});
  const BodyClasses b = solid_classes(lattice, edge, solid, {false, false, true});
  const auto near = [](double value, double wanted) { EXPECT_NEAR(value, wanted, 1e-13 * std::abs(wanted)); };
  for (std::size_t i = 0; i < 3; ++i) {
    const VoxelCoefficients<double>& x = a.voxel[a.voxel_class[i]];
    const VoxelCoefficients<double>& y = b.voxel[b.voxel_class[i]];
    near(a.mass_kg[i], b.mass_kg[i]);
    near(x.inverse_mass, y.inverse_mass);
    near(x.inverse_inertia, y.inverse_inertia);
    near(x.weight, y.weight);
    near(x.global_damping, y.global_damping);
    near(x.global_rotation_damping, y.global_rotation_damping);
    near(x.floor.stiffness, y.floor.stiffness);
    near(x.floor.damping, y.floor.damping);
    near(x.floor.static_friction, y.floor.static_friction);
    near(x.floor.kinetic_friction, y.floor.kinetic_friction);
  }
}

TEST(CalibratedBody, GivesTheSameBytesFromAllInstructionSets) {
  const auto state = [](const Physics& physics, InstructionSet set) {
    std::vector<double> numbers;
    try {
      Simulation simulation(meshes::fractal(standing_quadruped, 1), edge, physics, {}, {.instruction_set = set});
      EXPECT_EQ(simulation.advance(2000), io::RunStatus::completed);
      for (std::size_t i = 0; i < simulation.voxel_count(); ++i) {
        for (const double value : simulation.position_m(i)) numbers.push_back(value);
        for (const double value : simulation.orientation(i)) numbers.push_back(value);
        for (const double value : simulation.velocity_m_s(i)) numbers.push_back(value);
      }
    } catch (const std::invalid_argument&) {  // this machine has no such kernels
      numbers.clear();
    }
    return numbers;
  };
  Physics physics = driven_by(example_body());
  std::vector<Physics> scenes(3, physics);
  scenes[1].integration.damping = DampingMode::velocity;
  scenes[2].integration.damping = DampingMode::velocity;
  scenes[2].integration.number = NumberType::float32;
  for (const Physics& scene : scenes) {
    const std::vector<double> scalar = state(scene, InstructionSet::scalar);
    ASSERT_FALSE(scalar.empty());
    for (const InstructionSet set : {InstructionSet::best, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
      const std::vector<double> packed = state(scene, set);
      if (packed.empty()) continue;
      ASSERT_EQ(packed.size(), scalar.size());
      EXPECT_EQ(std::memcmp(packed.data(), scalar.data(), scalar.size() * sizeof(double)), 0) << static_cast<int>(set);
    }
  }
}

TEST(CalibratedBody, MovesTheSameBesideTheEnergyLedgerAndWithEveryTerm) {
  const Physics physics = driven_by(example_body());
  Simulation plain(standing_quadruped, edge, physics);
  Simulation booked(standing_quadruped, edge, physics, {}, {.energy_ledger = true});
  Simulation full(standing_quadruped, edge, physics, {}, {.every_term = true});
  for (Simulation* simulation : {&plain, &booked, &full}) ASSERT_EQ(simulation->advance(1500), io::RunStatus::completed);
  for (std::size_t i = 0; i < plain.voxel_count(); ++i) {
    EXPECT_EQ(plain.position_m(i), booked.position_m(i));
    EXPECT_EQ(plain.position_m(i), full.position_m(i));
  }
}

TEST(CalibratedBody, ClosesItsEnergyLedger) {
  for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
    Physics physics = floating(driven_by(example_body()));
    physics.integration.damping = mode;
    Simulation simulation(standing_quadruped, edge, physics, {}, {.energy_ledger = true});
    ASSERT_EQ(simulation.advance_to(0.6), io::RunStatus::completed);
    const EnergyLedger& energy = *simulation.energy();
    EXPECT_GT(energy.actuation_work_J, 0.0);
    // Geometric nonlinearity, as for solid voxels.
    EXPECT_LT(std::abs(energy.residual_J()), 2e-3 * energy.actuation_work_J);
  }
}

TEST(CalibratedBody, SettlesAtTheLengthOfItsLawUnderHold) {
  CalibratedBody body = example_body();
  body.parameters.lateral_coupling = 0.0;
  body.pressure_Pa = {800.0, 800.0};
  Physics physics = floating(driven_by(body, ActuationMode::hold));
  physics.actuation.ramp_s = 0.2;
  Simulation simulation(meshes::bar(3), edge, physics);
  ASSERT_EQ(simulation.advance_to(1.5), io::RunStatus::completed);
  // A bar without load: every half has its driven length. Along x all three voxels have walls on four sides.
  const double length = simulation.position_m(2)[0] - simulation.position_m(0)[0];
  EXPECT_NEAR(length, 2.0 * edge * (1.0 + body.parameters.extension[closed_wall_class].value(800.0)), 1e-9 * edge);
  // The middle voxel has no end walls: two opposite ones of its four sides parallel to z carry a wall, of those of the others
  // three.
  const auto size = [&](std::size_t c) { return edge * (1.0 + body.parameters.extension[c].value(800.0)); };
  EXPECT_NEAR(simulation.frame().size_m[1], size(walls::limb), 1e-12);
  EXPECT_NEAR(simulation.frame().size_m[0], size(walls::three), 1e-12);
}

TEST(SolidBody, SettlesAtItsAmplitudeUnderHold) {
  Physics physics = floating({});
  physics.actuation.mode = ActuationMode::hold;
  physics.actuation.amplitude = 0.1;
  physics.actuation.ramp_s = 0.05;
  for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
    physics.integration.damping = mode;
    Simulation simulation(meshes::bar(2), edge, physics);
    EXPECT_DOUBLE_EQ(simulation.frame().size_m[0], edge);
    ASSERT_EQ(simulation.advance_to(0.5), io::RunStatus::completed);
    EXPECT_NEAR(simulation.position_m(1)[0] - simulation.position_m(0)[0], 1.1 * edge, 1e-9 * edge);
  }
}

TEST(CalibratedBody, HasThePressureOfItsPhaseInEveryChamber) {
  CalibratedBody body = example_body();
  body.chambers = body.parameters.chambers = meshes::ChamberLayout::per_phase;
  body.pressure_Pa = {-200.0, 800.0};
  Physics physics = floating(driven_by(body, ActuationMode::antiphase));
  Simulation simulation(meshes::Polycube::from_digits(2, 1, 1, "12"), edge, physics);
  ASSERT_EQ(simulation.advance_to(0.05), io::RunStatus::completed);
  // A quarter of the period: one chamber at the highest, the other at the lowest pressure (up to less than a step). Both voxels
  // have walls on all sides.
  const auto length = [&](double pressure) {
    return edge * (1.0 + body.parameters.extension[closed_wall_class].value(pressure));
  };
  EXPECT_NEAR(simulation.frame().size_m[0], length(800.0), 1e-5 * edge);
  EXPECT_NEAR(simulation.frame().size_m[1], length(-200.0), 1e-5 * edge);
}

/// The message of the exception that a simulation throws.
std::string refusal(const meshes::Polycube& body, const Physics& physics, double cell_edge_m = edge) {
  try {
    const Simulation simulation(body, cell_edge_m, physics);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "accepted";
}

TEST(CalibratedBody, RefusesPhasesThatOneChamberCannotHave) {
  const meshes::Polycube two = meshes::Polycube::from_digits(2, 1, 1, "12");
  EXPECT_NE(refusal(two, driven_by(example_body(), ActuationMode::antiphase)).find("a chamber has one pressure"),
            std::string::npos);
  EXPECT_NE(refusal(two, driven_by(example_body(), ActuationMode::wave)).find("accepted"), std::string::npos)
      << "the wave runs along y, where the body is one cell wide";
  EXPECT_EQ(refusal(two, driven_by(example_body())), "accepted");
  EXPECT_EQ(refusal(meshes::bar(2), driven_by(example_body(), ActuationMode::antiphase)), "accepted");
}

TEST(CalibratedBody, RefusesWhatItsParametersWereNotFittedOn) {
  CalibratedBody body = example_body();
  EXPECT_NE(refusal(meshes::bar(2), driven_by(body), 0.02).find("cell_edge_m = 0.01, the design has cell_edge_m = 0.02"),
            std::string::npos);
  body.parameters.validity.set_pressures(-1e4, 500.0);
  EXPECT_NE(refusal(meshes::bar(2), driven_by(body)).find("pressure_Pa = 1000 is outside"), std::string::npos);
  body.outside_range = OutsideRange::warn;
  EXPECT_EQ(refusal(meshes::bar(2), driven_by(body)), "accepted");
  body = example_body();
  body.parameters.validity.longest_body_cells = 2;
  EXPECT_NE(refusal(meshes::bar(3), driven_by(body)).find("3 cells long, the longest of the fit was 2"), std::string::npos);
  body = example_body();
  body = example_body();
  body.level = 2;
  body.parameters.validity.longest_aggregate_modules = 2;
  EXPECT_EQ(outside_validity(body, meshes::bar(2)), std::vector<std::string>{});
  EXPECT_EQ(outside_validity(body, meshes::bar(3)),
            std::vector<std::string>{"the body is 3 modules long, the longest of the fit was 2"});
  body = example_body();
  body.parameters.extension[walls::limb].pressure_softening_per_Pa = 1e-3;  // of the middle of the bar, across it
  EXPECT_NE(refusal(meshes::bar(3), driven_by(body))
                .find("voxels with walls on two opposite sides (wall class 2o) have no equilibrium"),
            std::string::npos);
  EXPECT_EQ(refusal(meshes::bar(2), driven_by(body)), "accepted") << "it has no such class";
}

TEST(CalibratedBody, DivergesWhereItsStrainsLeaveTheRangeOfValidity) {
  CalibratedBody body = example_body();
  body.parameters.validity.largest_strain = 1e-4;
  Simulation refused(standing_quadruped, edge, driven_by(body));
  EXPECT_EQ(refused.advance(5000), io::RunStatus::diverged);
  ASSERT_TRUE(refused.divergence());
  EXPECT_EQ(refused.divergence()->quantity, "strain outside the range of validity");
  EXPECT_GT(*refused.divergence()->value, 1e-4);
  body.outside_range = OutsideRange::warn;
  Simulation warned(standing_quadruped, edge, driven_by(body));
  EXPECT_EQ(warned.advance(5000), io::RunStatus::completed);
  ASSERT_TRUE(warned.strain_range());
  EXPECT_GT(warned.strain_range()->largest, 1e-4);
}

TEST(CalibratedBody, DoesNotBulgeIntoItsOwnVoxels) {
  // Voxels across a corner are sqrt(2) L apart and joined by two beams; with a bulge of a fifth of the edge their spheres of
  // 0.625 of the size would overlap at rest if they had it.
  CalibratedBody body = example_body();
  body.parameters.bulge.fill({.slope_per_Pa = 1e-4});
  body.pressure_Pa = {1000.0, 1000.0};
  Physics physics = driven_by(body, ActuationMode::hold);
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  Simulation colliding(standing_quadruped, edge, physics);
  physics.collisions.exclusion_depth.reset();
  Simulation free(standing_quadruped, edge, physics);
  for (Simulation* simulation : {&colliding, &free}) ASSERT_EQ(simulation->advance(500), io::RunStatus::completed);
  EXPECT_GT(free.frame().reach_m[0][4], 0.55 * edge) << "walls bulge";
  for (std::size_t i = 0; i < free.voxel_count(); ++i) EXPECT_EQ(colliding.position_m(i), free.position_m(i));
}

TEST(BasalBody, IsFoundInItsFractal) {
  EXPECT_EQ(basal_body_of(meshes::fractal(standing_quadruped, 2), 2), standing_quadruped);
  EXPECT_EQ(basal_body_of(standing_quadruped, 1), standing_quadruped);
  EXPECT_THROW(basal_body_of(meshes::Polycube::from_digits(4, 1, 1, "1011"), 2), std::invalid_argument);
  EXPECT_THROW(basal_body_of(meshes::bar(5), 2), std::invalid_argument);
}

TEST(CalibratedBody, OfHigherLevelsHasOneChamberPerModule) {
  CalibratedBody body = example_body();
  body.level = 2;
  const HollowVoxels voxels = calibrated_voxels(meshes::fractal(standing_quadruped, 2), body);
  EXPECT_EQ(voxels.chamber_count, standing_quadruped.count());
  Simulation simulation(meshes::fractal(standing_quadruped, 2), edge, driven_by(body));
  EXPECT_EQ(simulation.advance(200), io::RunStatus::completed);
}

}  // namespace
}  // namespace menger::voxel
