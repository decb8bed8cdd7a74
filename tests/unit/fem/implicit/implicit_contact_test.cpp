#include "fem/implicit/implicit_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "fem/explicit/explicit_contact.h"
#include "tests/unit/fem/implicit/implicit_samples.h"

namespace menger::fem {
namespace {

constexpr double stiffness = 6e7;

RigidGround rough(double static_coefficient, double kinetic_coefficient, double speed = 0.0) {
  return {.height_m = 1e-5,
          .stiffness_Pa_per_m = stiffness,
          .friction = {.static_coefficient = static_coefficient,
                       .kinetic_coefficient = kinetic_coefficient,
                       .regularisation_speed_m_per_s = speed}};
}

/// A block whose lower nodes lie 10 um deep at rest.
struct Block {
  ImplicitSample sample;
  Assembly assembly;
  explicit Block(int degree = 1)
      : sample(meshes::box({4e-3, 4e-3, 2e-3}, {2, 2, 1}), degree), assembly(sample.space, sample.body) {}

  [[nodiscard]] std::vector<double> moved(const Point& way) const {
    return at_nodes(sample.space, [&](const Point&) { return way; });
  }
};

struct Response {
  std::vector<double> residual;
  std::vector<GroundNode> nodes;
  GroundTotals totals;
};

Response response(const Block& block, const ImplicitContact& contact, const StepMotion& motion,
                  const std::vector<GroundNode>& before) {
  Response result{block.moved({}), before, {}};
  result.totals = contact.add_forces(motion, before, result.nodes, result.residual);
  return result;
}

Point total_force(const Response& result) {
  Point force{};
  for (std::size_t n = 0; n < result.residual.size(); ++n) force[n % 3] -= result.residual[n];
  return force;
}

// Springs of nodes are those of explicit dynamics on elements of degree 1; for both degrees the lower face of 16 mm^2 and the
// part of the four sides that is next to it bear: half an element high for degree 1, a sixth (Simpson's rule) for degree 2.
TEST(ImplicitContact, SpringsComeFromOuterAreas) {
  for (const int degree : {1, 2}) {
    const Block block(degree);
    const ImplicitContact contact(block.assembly, block.sample.body, rough(0.0, 0.0), 1.0);
    const std::vector<double> u = block.moved({});
    const Response result = response(block, contact, {u, u, u, 0.0}, contact.free_nodes());
    const double area = 16e-6 + 16e-3 * 2e-3 * (degree == 1 ? 0.5 : 1.0 / 6.0);
    EXPECT_NEAR(result.totals.force_N, stiffness * area * 1e-5, 1e-12);
    EXPECT_NEAR(result.totals.normal_energy_J, 0.5 * stiffness * area * 1e-10, 1e-18);
    EXPECT_NEAR(total_force(result)[2], result.totals.force_N, 1e-12);
    if (degree == 1) {
      std::vector<double> positions;
      for (const Point& X : block.sample.mesh.points) positions.insert(positions.end(), X.begin(), X.end());
      EXPECT_NEAR(result.totals.force_N, ground_force_N(rough(0.0, 0.0), positions, outer_node_areas_m2(block.sample.mesh)),
                  1e-12);
    }
  }
}

// A pull on stick springs that stays below the static friction is given back; in the step in which it breaks loose static
// friction remains, from the next on the kinetic one, and the anchors follow.
TEST(ImplicitContact, SticksUpToStaticFrictionAndSlidesAtKinetic) {
  const Block block;
  const ImplicitContact contact(block.assembly, block.sample.body, rough(0.8, 0.5), 0.5);
  const std::vector<double> start = block.moved({});
  const Response lying = response(block, contact, {start, start, start, 0.0}, contact.free_nodes());
  const double normal = lying.totals.force_N;
  const auto slide_to = [&](double from, double to, const std::vector<GroundNode>& before) {
    const std::vector<double> begin = block.moved({0.6 * from, 0.8 * from, 0.0});
    const std::vector<double> end = block.moved({0.6 * to, 0.8 * to, 0.0});
    return response(block, contact, {begin, end, start, 0.0}, before);
  };
  // 10 um deep, the stick spring is half as stiff: friction 0.8 N is reached at 16 um.
  const Response pulled = slide_to(0.0, 15e-6, lying.nodes);
  EXPECT_NEAR(total_force(pulled)[0], -0.6 * 0.75 * normal, 1e-12);
  EXPECT_NEAR(total_force(pulled)[1], -0.8 * 0.75 * normal, 1e-12);
  EXPECT_EQ(pulled.totals.friction_loss_J, 0.0);
  EXPECT_NEAR(pulled.totals.stick_energy_J, 0.5 * 0.75 * normal * 15e-6, 1e-16);
  const Response back = slide_to(15e-6, 0.0, pulled.nodes);
  EXPECT_NEAR(norm(difference(total_force(back), {0.0, 0.0, normal})), 0.0, 1e-12);
  const Response slid = slide_to(15e-6, 30e-6, pulled.nodes);
  EXPECT_NEAR(std::hypot(total_force(slid)[0], total_force(slid)[1]), 0.8 * normal, 1e-12);
  // it gave way by 14 um, under the mean of 0.75 and 0.8 N
  EXPECT_NEAR(slid.totals.friction_loss_J, 0.775 * normal * 14e-6, 1e-15);
  // from sliding, kinetic friction is the limit
  const Response on = slide_to(30e-6, 40e-6, slid.nodes);
  EXPECT_NEAR(std::hypot(total_force(on)[0], total_force(on)[1]), 0.5 * normal, 1e-12);
  // from 14 to 30 um, under the mean of 0.8 and 0.5 N
  EXPECT_NEAR(on.totals.friction_loss_J, 0.65 * normal * 16e-6, 1e-15);
  // lifted, it forgets
  const std::vector<double> up = block.moved({0.0, 0.0, 1.0});
  const Response lifted = response(block, contact, {start, up, start, 0.0}, on.nodes);
  EXPECT_EQ(norm(total_force(lifted)), 0.0);
  EXPECT_NEAR(lifted.totals.friction_loss_J, 0.5 * 0.5 * normal * 10e-6, 1e-15);
}

// A node that goes on in one direction slides on, however its normal force changes: static friction has no part in it, and at
// 2 mm/s, beyond 0.5 dN/dt over the spring (0.8 mm/s), the mean is kinetic friction. Kinetic friction with and without steps that
// follow each other closely.
TEST(ImplicitContact, SlidingOnDoesNotFeelStaticFriction) {
  const Block block;
  const auto mean_friction = [&](double static_coefficient, double speed, double step_s) {
    const ImplicitContact contact(block.assembly, block.sample.body, rough(static_coefficient, 0.5), 1.0);
    const auto place = [&](double t) {
      return block.moved({speed * t, 0.0, 5e-6 * std::sin(2.0 * 3.14159265358979 * 50.0 * t)});
    };
    std::vector<GroundNode> nodes = contact.free_nodes();
    const auto steps = static_cast<int>(std::lround(0.1 / step_s));
    double friction = 0.0;
    double normal = 0.0;
    for (int n = 0; n < steps; ++n) {
      const std::vector<double> from = place(n * step_s);
      const std::vector<double> to = place((n + 1) * step_s);
      const Response result = response(block, contact, {from, to, block.moved({speed, 0.0, 0.0}), 0.0}, nodes);
      nodes = result.nodes;
      if (2 * n < steps) continue;  // the pull builds up
      friction -= total_force(result)[0];
      normal += result.totals.force_N;
    }
    return friction / normal;
  };
  for (const double step : {1e-3, 1e-4}) {
    EXPECT_NEAR(mean_friction(0.5, 2e-3, step), 0.5, 1e-3) << step;
    for (const double speed : {2e-3, 1e-4}) EXPECT_EQ(mean_friction(1.0, speed, step), mean_friction(0.5, speed, step)) << step;
  }
}

// Without friction there is no stick spring either.
TEST(ImplicitContact, SmoothGroundHoldsNothing) {
  const Block block;
  const ImplicitContact contact(block.assembly, block.sample.body, rough(0.0, 0.0), 1.0);
  const std::vector<double> start = block.moved({});
  const Response lying = response(block, contact, {start, start, start, 0.0}, contact.free_nodes());
  const std::vector<double> end = block.moved({1e-5, 0.0, 0.0});
  const Response moved = response(block, contact, {start, end, start, 0.0}, lying.nodes);
  EXPECT_EQ(total_force(moved)[0], 0.0);
  EXPECT_EQ(moved.totals.friction_loss_J, 0.0);
  EXPECT_EQ(moved.totals.stick_energy_J, 0.0);
}

// What nodes remember is what a state is taken up with: the same forces and the same memory, of nodes that stick and that slide.
TEST(ImplicitContact, RemembersItsForces) {
  const Block block;
  const ImplicitContact contact(block.assembly, block.sample.body, rough(0.8, 0.5), 0.5);
  const std::vector<double> start = block.moved({});
  const Response lying = response(block, contact, {start, start, start, 0.0}, contact.free_nodes());
  for (const double way : {10e-6, 30e-6}) {
    const std::vector<double> end = block.moved({way, 0.0, 0.0});
    const Response pulled = response(block, contact, {start, end, start, 0.0}, lying.nodes);
    std::vector<double> residual = block.moved({});
    const GroundTotals totals = contact.add_remembered_forces(end, pulled.nodes, residual);
    EXPECT_EQ(residual, pulled.residual);
    EXPECT_EQ(totals.force_N, pulled.totals.force_N);
    EXPECT_EQ(totals.stick_energy_J, pulled.totals.stick_energy_J);
    EXPECT_GT(totals.stick_energy_J, 0.0);
  }
}

// By velocity: in proportion up to the regularisation speed, kinetic beyond, weaker backwards where that is asked for.
TEST(ImplicitContact, RegularisedFrictionFollowsTheSpeed) {
  const Block block;
  RigidGround ground = rough(0.8, 0.5, 1e-3);
  ground.friction.directional = DirectionalFriction{.backward_factor = 0.25};
  const ImplicitContact contact(block.assembly, block.sample.body, ground, 1.0);
  const std::vector<double> u = block.moved({});
  const auto friction = [&](double speed) {
    const Response result = response(block, contact, {u, u, block.moved({speed, 0.0, 0.0}), 0.0}, contact.free_nodes());
    return total_force(result)[0] / result.totals.force_N;
  };
  EXPECT_NEAR(friction(0.5e-3), -0.4, 1e-12);
  EXPECT_NEAR(friction(1.0), -0.5, 1e-12);
  EXPECT_NEAR(friction(-1.0), 0.125, 1e-12);
}

// The matrix is the derivative of the residual but for what friction owes to the normal force: checked in each direction of the
// plane, and up, with one node stuck, sliding obliquely, or creeping. Central differences of 1e-9 m: 1e-6 of the largest.
TEST(ImplicitContact, MatrixMatchesCentralDifferences) {
  const Block block;
  for (const double speed : {0.0, 1e-2}) {
    const ImplicitContact contact(block.assembly, block.sample.body, rough(0.8, 0.5, speed), 1.0);
    for (const double way : {3e-6, 30e-6}) {
      const std::vector<double> start = block.moved({});
      const Response lying = response(block, contact, {start, start, start, 0.0}, contact.free_nodes());
      const std::vector<double> end = block.moved({0.6 * way, 0.8 * way, 0.0});
      constexpr double by_displacement = 2e3;
      const auto at = [&](const std::vector<double>& u) {
        std::vector<double> v = u;
        for (double& value : v) value *= by_displacement;
        return response(block, contact, {start, u, v, by_displacement}, lying.nodes).residual;
      };
      std::vector<double> velocities = end;
      for (double& value : velocities) value *= by_displacement;
      const MatrixHandle matrix = block.assembly.make_matrix(false);
      petsc(MatZeroEntries(matrix));
      contact.add_matrix({start, end, velocities, by_displacement}, lying.nodes, matrix);
      petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
      petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
      std::size_t lowest = 0;  // some node on the ground
      while (block.sample.space.positions[lowest][2] > 0.0) ++lowest;
      for (std::size_t k = 0; k < 3; ++k) {
        std::vector<double> forth = end;
        std::vector<double> back = end;
        forth[3 * lowest + k] += 1e-9;
        back[3 * lowest + k] -= 1e-9;
        const std::vector<double> plus = at(forth);
        const std::vector<double> minus = at(back);
        for (std::size_t i = 0; i < 3; ++i) {
          if (k == 2 && i < 2) continue;
          const auto row = static_cast<PetscInt>(3 * lowest + i);
          const auto column = static_cast<PetscInt>(3 * lowest + k);
          double entry = 0.0;
          petsc(MatGetValues(matrix, 1, &row, 1, &column, &entry));
          EXPECT_NEAR(entry, (plus[3 * lowest + i] - minus[3 * lowest + i]) / 2e-9, 1e-6 * stiffness * 4e-6) << i << k << way;
        }
      }
    }
  }
}

}  // namespace
}  // namespace menger::fem
