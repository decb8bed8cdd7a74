// Damping of bonds that bounds no step: what it does to the motion it is made for, and that it vanishes with the step.

#include "voxel/model/bond_damping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/toml_document.h"
#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/surrogate_example.h"
#include "voxel/engine/voxel_classes.h"
#include "voxel/lanes/simulation.h"
#include "voxel/laws/lattice.h"
#include "voxel/scene/physics_file.h"

namespace menger::voxel {
namespace {

constexpr double edge = 0.01;

Physics floating(BondDamping treatment, double fraction, double ratio = 1.0) {
  Physics physics;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.damping_ratios = {.bond = ratio, .collision = 0.0, .global = 0.0};
  physics.actuation.mode = ActuationMode::none;
  physics.collisions.exclusion_depth.reset();
  physics.integration.time_step_fraction = fraction;
  physics.integration.damping = DampingMode::velocity;
  physics.integration.bond_damping = treatment;
  return physics;
}

TEST(BondDamping, TreatsNeighboursAgainstEachOtherAsBackwardEulerWould) {
  // A cube whose voxels all move against their six neighbours, from an unstrained start: the bonds' rate on an inner voxel is 12
  // zeta omega, and h omega is the fraction over 2 pi. Explicit: v (1 - x), backward Euler: v / (1 + x).
  const meshes::Polycube body = meshes::full_cube(5);
  for (const double ratio : {0.3, 1.0}) {
    for (const double fraction : {0.1, 0.9, 5.0}) {
      const double x = 12.0 * ratio * fraction / (2.0 * std::numbers::pi);
      for (const BondDamping treatment : {BondDamping::explicit_step, BondDamping::semi_implicit}) {
        VoxelLoads loads;
        std::size_t inner = 0;
        const std::vector<meshes::CellIndex> cells = body.occupied();
        for (std::size_t i = 0; i < cells.size(); ++i) {
          const meshes::CellIndex& cell = cells[i];
          const double speed = (cell.x + cell.y + cell.z) % 2 == 0 ? 1e-3 : -1e-3;
          loads.initial_velocity_m_s.push_back({speed, 2.0 * speed, -speed});
          if (cell == meshes::CellIndex{2, 2, 2}) inner = i;
        }
        Simulation simulation(body, edge, floating(treatment, fraction, ratio), loads);
        ASSERT_EQ(simulation.advance(1), io::RunStatus::completed);
        const double factor = treatment == BondDamping::explicit_step ? 1.0 - x : 1.0 / (1.0 + x);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double before = loads.initial_velocity_m_s[inner].at(axis);
          EXPECT_NEAR(simulation.velocity_m_s(inner).at(axis) / before, factor, 1e-10);  // rounded positions strain the bonds
        }
      }
    }
  }
}

/// Whether a body that was shaken comes to rest.
bool calms_down(const meshes::Polycube& body, const Physics& physics) {
  VoxelLoads loads;
  for (std::size_t i = 0; i < body.count(); ++i) {
    const double speed = 1e-4 * std::sin(7.0 * static_cast<double>(i * i));
    loads.initial_velocity_m_s.push_back({speed, -0.5 * speed, 0.3 * speed});
  }
  Simulation simulation(body, edge, physics, loads);
  if (simulation.advance(4000) != io::RunStatus::completed) return false;
  double largest = 0.0;
  for (std::size_t i = 1; i < body.count(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(simulation.velocity_m_s(i).at(axis) - simulation.velocity_m_s(0).at(axis)));
  }
  return largest < 1e-4;
}

bool calms_down(const meshes::Polycube& body, BondDamping treatment, double fraction) {
  return calms_down(body, floating(treatment, fraction));
}

/// A cube of 3 x 3 x 3 whose cells of the two materials alternate, with a light one in the middle.
meshes::Polycube checkerboard() { return meshes::Polycube::from_digits(3, 3, 3, "212121212121212121212121212"); }

Physics with_heavier_neighbours(const Physics& given, double ratio) {
  Physics physics = given;
  physics.materials[1].density_kg_m3 = ratio * physics.materials[0].density_kg_m3;
  return physics;
}

/// The largest rate, 1/s, at which bonds damp shifts of the voxels of a body along an axis, by power iteration.
double largest_damping_rate_per_s(const meshes::Polycube& body, const Physics& physics) {
  const Lattice lattice(body);
  const BodyClasses classes = solid_classes(lattice, edge, physics, {});
  std::vector<double> velocity(lattice.voxel_count());
  for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = std::sin(7.0 * static_cast<double>(i * i + 1));
  double rate = 0.0;
  for (int iteration = 0; iteration < 2000; ++iteration) {
    std::vector<double> slowing(velocity.size(), 0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const AxisBeams& beams = lattice.beams[axis];
      for (std::size_t i = 0; i < beams.lower.size(); ++i) {
        const auto lower = static_cast<std::size_t>(beams.lower[i]);
        const auto upper = static_cast<std::size_t>(beams.upper[i]);
        const BeamCoefficients<double>& beam = classes.beam[classes.beam_class[axis][i]];
        const double pull = beam.axial_root * (velocity[upper] - velocity[lower]);
        slowing[lower] -= beam.damping_lower * pull / classes.mass_kg[lower];
        slowing[upper] += beam.damping_upper * pull / classes.mass_kg[upper];
      }
    }
    rate = 0.0;
    for (const double value : slowing) rate = std::max(rate, std::abs(value));
    for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = slowing[i] / rate;
  }
  return rate;
}

TEST(BondDamping, OfTwoDensitiesIsNoFasterThanItsBound) {
  const double zeta_omega = std::sqrt(1e7);  // 1/s, of the light voxels
  struct Case {
    double ratio, rate;  // of densities; the largest one by zeta omega
  };
  for (const auto& [ratio, rate] : {Case{5.8, 10.6}, {9.0, 12.3}, {16.0, 15.2}, {49.0, 24.1}, {100.0, 33.1}, {400.0, 63.0}}) {
    Physics physics = with_heavier_neighbours(floating(BondDamping::explicit_step, 0.9), ratio);
    const double largest = largest_damping_rate_per_s(checkerboard(), physics) / zeta_omega;
    EXPECT_NEAR(largest, rate, 0.1) << ratio;
    const double factor = bond_rate_factor(physics, 10.0, 10.0 * ratio);
    EXPECT_LE(largest, 12.0 * factor) << ratio;
    EXPECT_GE(largest, 0.85 * 12.0 * factor) << ratio << ": the bound is not far off";
    EXPECT_EQ(factor, bond_rate_factor(physics, 10.0 * ratio, 10.0));
    // Each end with a coefficient of its own.
    physics.integration.damping = DampingMode::increments;
    EXPECT_LE(largest_damping_rate_per_s(checkerboard(), physics), 12.0 * zeta_omega) << ratio;
    EXPECT_EQ(bond_rate_factor(physics, 10.0, 10.0 * ratio), 1.0);
    physics.beam_moments = BeamMoments::balanced;
    EXPECT_EQ(bond_rate_factor(physics, 10.0, 10.0 * ratio), factor);
  }
  EXPECT_EQ(bond_rate_factor(floating(BondDamping::explicit_step, 0.9), 1070.0 / 3.0, 1070.0 / 3.0), 1.0);
}

TEST(BondDamping, OfTwoDensitiesIsStableAtTheDefaultStep) {
  for (const double ratio : {16.0, 100.0, 400.0}) {
    for (const BondDamping treatment : {BondDamping::explicit_step, BondDamping::semi_implicit})
      EXPECT_TRUE(calms_down(checkerboard(), with_heavier_neighbours(floating(treatment, 0.9), ratio))) << ratio;
    EXPECT_TRUE(calms_down(checkerboard(), with_heavier_neighbours(floating(BondDamping::semi_implicit, 0.9, 100.0), ratio)))
        << ratio;
  }
}

TEST(BondDamping, OfTwoDensitiesLeavesTheRatioOfItsBound) {
  const Physics physics = with_heavier_neighbours(floating(BondDamping::semi_implicit, 0.9), 100.0);
  const double factor = 0.25 * 11.0 * 1.01;
  EXPECT_DOUBLE_EQ(effective_bond_ratio(physics), 1.0 / (1.0 + 5.4 * factor / std::numbers::pi));
}

TEST(BondDamping, BoundsTheStepNoLongerThanTheStiffnessDoes) {
  // Eigenvalues of the linear scheme for a full cube of 3 x 3 x 3: stable up to a fraction of 1.17 where the damping is explicit,
  // 3.06 where it is semi-implicit (3.58 without damping); a Menger sponge 1.80 and 3.92.
  const meshes::Polycube cube = meshes::full_cube(3);
  EXPECT_TRUE(calms_down(cube, BondDamping::explicit_step, 1.1));
  EXPECT_FALSE(calms_down(cube, BondDamping::explicit_step, 1.25));
  EXPECT_TRUE(calms_down(cube, BondDamping::semi_implicit, 2.9));
  EXPECT_FALSE(calms_down(cube, BondDamping::semi_implicit, 3.25));
  const meshes::Polycube sponge = meshes::menger_sponge();
  EXPECT_TRUE(calms_down(sponge, BondDamping::explicit_step, 1.7));
  EXPECT_FALSE(calms_down(sponge, BondDamping::explicit_step, 1.95));
  EXPECT_TRUE(calms_down(sponge, BondDamping::semi_implicit, 3.7));
  EXPECT_FALSE(calms_down(sponge, BondDamping::semi_implicit, 4.2));
}

TEST(BondDamping, BecomesTheExplicitOneWithTheStep) {
  // Ratio of the two: 1 + 6 zeta fraction / pi.
  Physics physics = floating(BondDamping::semi_implicit, 0.9);
  EXPECT_DOUBLE_EQ(effective_bond_ratio(physics), 1.0 / (1.0 + 5.4 / std::numbers::pi));
  physics.integration.time_step_fraction = 1e-6;
  EXPECT_NEAR(effective_bond_ratio(physics), 1.0, 2e-6);
  physics.integration.bond_damping = BondDamping::explicit_step;
  EXPECT_EQ(effective_bond_ratio(physics), 1.0);
  physics.integration.bond_damping = BondDamping::semi_implicit;
  physics.damping_ratios.bond = 0.0;
  EXPECT_EQ(effective_bond_ratio(physics), 0.0);
}

TEST(BondDamping, IsThatOfASmallerRatio) {
  // The same bytes as with explicit damping of that ratio, in blocks and lanes as well.
  const meshes::Polycube body = meshes::fractal(meshes::menger_sponge(), 2);
  Physics implicit;
  implicit.integration.bond_damping = BondDamping::semi_implicit;
  Physics weaker;
  weaker.damping_ratios.bond = effective_bond_ratio(implicit);
  Simulation a(body, edge, implicit);
  Simulation b(body, edge, weaker);
  ASSERT_EQ(a.advance(500), io::RunStatus::completed);
  ASSERT_EQ(b.advance(500), io::RunStatus::completed);
  EXPECT_EQ(a.centre_of_mass_m(), b.centre_of_mass_m());
  EXPECT_EQ(a.position_m(17), b.position_m(17));
  Simulation strong(body, edge, Physics{});
  ASSERT_EQ(strong.advance(500), io::RunStatus::completed);
  EXPECT_NE(a.position_m(17), strong.position_m(17));
}

TEST(BondDamping, IsReadAndWritten) {
  const auto parse = [](const std::string& text) {
    const io::TomlTable table = io::parse_toml(text, "physics.toml");
    Physics physics = read_physics(table);
    table.finish();
    return physics;
  };
  const Physics physics = parse("[integration]\nbond_damping = \"semi-implicit\"\n");
  EXPECT_EQ(physics.integration.bond_damping, BondDamping::semi_implicit);
  EXPECT_EQ(parse(physics_text(physics)), physics);
  EXPECT_EQ(parse("[integration]\nbond_damping = \"explicit\"\n"), Physics{});
  try {
    static_cast<void>(parse("[integration]\nbond_damping = \"implicit\"\n"));
    FAIL() << "accepted";
  } catch (const io::InputError& error) {
    for (const char* word : {"physics.toml:2", "integration.bond_damping = ", "implicit", "semi-implicit"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(BondDamping, OfACalibratedBodyIsThatOfItsParameters) {
  Physics physics;
  physics.surrogate.emplace();
  physics.surrogate->parameters = tests::surrogate_example();
  physics.integration.bond_damping = BondDamping::semi_implicit;
  try {
    const Simulation simulation(meshes::bar(3), physics.surrogate->parameters.cell_edge_m, physics);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("damping"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace menger::voxel
