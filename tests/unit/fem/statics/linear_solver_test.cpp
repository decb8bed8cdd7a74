#include "fem/statics/linear_solver.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "fem/statics/equilibrium.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/fem/statics/body_samples.h"

namespace menger::fem {
namespace {

constexpr double machine_bytes = 24e9;

Body block_body() {
  Body body;
  body.regions = {{materials::NeoHookean{5e4}, materials::SimoTaylorVolume{2.5e6}, 0.0}};
  body.supports = {{x_min, {true, true, true}}};
  return body;
}

/// The estimate for a block of linear elements, some along every edge.
FactorEstimate estimate_for_block(std::size_t elements) {
  const Space space = make_space(meshes::box({1.0, 1.0, 1.0}, {elements, elements, elements}), 1, 0, MPI_COMM_SELF);
  const Body body = block_body();
  const Assembly assembly(space, body);
  return estimate_factor(assembly.make_matrix(true));
}

TEST(LinearMethod, IsDirectForThinWallsOfAMillionUnknowns) {
  const LinearChoice choice = choose_linear_method(1'000'000, {.operations = 2e12, .bytes = 8e9}, machine_bytes);
  EXPECT_EQ(choice.method, LinearMethod::direct);
  EXPECT_EQ(choice.text(), "direct: a factorisation takes about 8 GB and 2e+12 operations");
}

TEST(LinearMethod, IsIterativeWhereFactorsTakeMoreThanHalfOfTheMemory) {
  EXPECT_EQ(choose_linear_method(1'000'000, {2e12, 11.9e9}, machine_bytes).method, LinearMethod::direct);
  const LinearChoice choice = choose_linear_method(1'000'000, {2e12, 12.1e9}, machine_bytes);
  EXPECT_EQ(choice.method, LinearMethod::iterative);
  EXPECT_NE(choice.reason.find("more than half of the 24 GB"), std::string::npos) << choice.reason;
  EXPECT_EQ(choose_linear_method(1'000'000, {2e12, 12.1e9}, 2.0 * machine_bytes).method, LinearMethod::direct);
}

TEST(LinearMethod, IsIterativeWhereAFactorisationTakesManyOperationsForEachUnknown) {
  EXPECT_EQ(choose_linear_method(300'000, {8.9e11, 1e9}, machine_bytes).method, LinearMethod::direct);
  const LinearChoice choice = choose_linear_method(300'000, {9.1e11, 1e9}, machine_bytes);
  EXPECT_EQ(choice.method, LinearMethod::iterative);
  EXPECT_NE(choice.reason.find("for each unknown"), std::string::npos) << choice.reason;
}

// The matrix of one element is full: n^3 / 3 operations with n = 24.
TEST(FactorEstimate, OfOneElementIsThatOfAFullMatrix) {
  const double operations = estimate_for_block(1).operations;
  EXPECT_GT(operations, 0.7 * 24.0 * 24.0 * 24.0 / 3.0);
  EXPECT_LT(operations, 1.5 * 24.0 * 24.0 * 24.0 / 3.0);
}

// Operations of a block grow at most with the square of its unknowns, memory with the power 4/3. Small blocks are below that.
TEST(FactorEstimate, GrowsWithTheBlock) {
  const FactorEstimate small = estimate_for_block(8);
  const FactorEstimate large = estimate_for_block(16);
  EXPECT_GT(large.operations, 20.0 * small.operations);
  EXPECT_LT(large.operations, 100.0 * small.operations);
  EXPECT_GT(large.bytes, 5.0 * small.bytes);
  EXPECT_LT(large.bytes, 30.0 * small.bytes);
}

TEST(LinearSolver, TellsWhatItChoseAndWhy) {
  const Space space = make_space(hollow_cube_quarter(), 1, 0, MPI_COMM_SELF);
  const Body body = quarter_body();
  const Assembly assembly(space, body);
  const long unknowns = 3 * static_cast<long>(space.node_count);
  EXPECT_EQ(LinearSolver(assembly, {}).choice().text(), "direct: " + std::to_string(unknowns) + " unknowns");
  EXPECT_EQ(LinearSolver(assembly, {.method = LinearMethod::iterative}).choice().text(), "iterative: as the study says");
  const LinearSolver estimated(assembly, {.largest_direct_size = 1});
  EXPECT_EQ(estimated.choice().method, LinearMethod::direct);
  EXPECT_NE(estimated.choice().reason.find(" operations"), std::string::npos) << estimated.choice().reason;
}

// The estimate leaves no trace in the solution.
TEST(LinearSolver, GivesTheSameBytesWithAnEstimate) {
  const Space space = make_space(hollow_cube_quarter(), 2, 0, MPI_COMM_SELF);
  const Body body = quarter_body();
  std::vector<BodyState> states;
  for (const int size : {1, 150'000}) {
    EquilibriumOptions options;
    options.linear.largest_direct_size = size;
    Equilibrium equilibrium(space, body, options);
    states.push_back(equilibrium.rest());
    const PlenumControl control = PressureControl{2e3};
    ASSERT_EQ(equilibrium.solve(states.back(), {&control, 1}, 1.0).status, io::RunStatus::completed);
  }
  EXPECT_EQ(states[0].displacements_m, states[1].displacements_m);
}

}  // namespace
}  // namespace menger::fem
