#include "fem/statics/newton_solver.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace menger::fem {
namespace {

/// A new tangent in each step: Newton's method itself.
const ReuseWhileResidualFalls never{[] { return 1.0; }, 0.0, 0.0};

/// f(x) = 0 for one unknown, solved where |f| is at most 1e-12, and what Newton's method did on the way.
class OneEquation {
 public:
  std::function<std::optional<double>(double)> function;  ///< nothing: no residual
  std::function<double(double)> derivative;
  std::function<void()> after_step{};
  bool can_prepare = true;
  bool can_solve = true;
  NewtonOptions options{.steps = HalvedSteps{}, .reuse = never};

  std::vector<double> visited;
  std::size_t evaluations = 0;    ///< of residuals, rejected trials included    ///< by steps
  std::vector<double> distances;  ///< that the check was given
  double x = 0.0;

  NewtonOutcome solve(double start, const std::atomic<bool>* stop = nullptr) {
    if (!solver_) {
      petsc(VecCreateSeq(MPI_COMM_SELF, 1, unknown_.receive()));
      solver_ = std::make_unique<NewtonSolver>(unknown_, problem(), options);
    }
    petsc(VecSet(unknown_, start));
    visited = {start};
    const NewtonOutcome outcome = solver_->solve(unknown_, stop);
    x = VectorReader(unknown_)[0];
    return outcome;
  }

  NewtonSolver& solver() { return *solver_; }

 private:
  NewtonProblem problem() {
    return {.residual =
                [this](Vec at, Vec residual) {
                  ++evaluations;
                  const std::optional<double> value = function(VectorReader(at)[0]);
                  if (value) VectorWriter{residual}[0] = residual_ = *value;
                  return value.has_value();
                },
            .prepare_tangent =
                [this](Vec at) {
                  tangent_ = derivative(VectorReader(at)[0]);
                  return can_prepare;
                },
            .solve_tangent =
                [this](Vec b, Vec y) {
                  VectorWriter{y}[0] = VectorReader(b)[0] / tangent_;
                  return can_solve;
                },
            .check =
                [this](const NewtonIterate& iterate) {
                  distances.push_back(iterate.distance);
                  return std::abs(residual_) <= 1e-12 ? NewtonVerdict::solved : NewtonVerdict::go_on;
                },
            .follow_step =
                [this](Vec, Vec to) {
                  visited.push_back(VectorReader(to)[0]);
                  if (after_step) after_step();
                }};
  }

  VectorHandle unknown_;
  std::unique_ptr<NewtonSolver> solver_;
  double residual_ = 0.0;
  double tangent_ = 1.0;
};

OneEquation arc_tangent() {
  OneEquation equation;
  equation.function = [](double x) { return std::optional(std::atan(x)); };
  equation.derivative = [](double x) { return 1.0 / (1.0 + x * x); };
  return equation;
}

OneEquation logarithm() {
  OneEquation equation;
  equation.function = [](double x) { return x > 0.0 ? std::optional(std::log(x)) : std::nullopt; };
  equation.derivative = [](double x) { return 1.0 / x; };
  return equation;
}

// x^2 + y^2 = 4 and x = y: the error after a step is the square of the one before over 2 sqrt(2).
TEST(NewtonSolver, ConvergesQuadraticallyToAKnownRoot) {
  VectorHandle unknown;
  petsc(VecCreateSeq(MPI_COMM_SELF, 2, unknown.receive()));
  double x = 3.0;
  double y = 1.0;
  double norm = 0.0;
  std::vector<double> errors;
  NewtonProblem problem{
      .residual =
          [&](Vec at, Vec residual) {
            const VectorReader u(at);
            const VectorWriter r(residual);
            r[0] = u[0] * u[0] + u[1] * u[1] - 4.0;
            r[1] = u[0] - u[1];
            norm = std::hypot(r[0], r[1]);
            return true;
          },
      .prepare_tangent =
          [&](Vec at) {
            const VectorReader u(at);
            x = u[0];
            y = u[1];
            return true;
          },
      .solve_tangent =
          [&](Vec b, Vec step) {
            const VectorReader r(b);
            const VectorWriter s(step);
            const double determinant = -2.0 * (x + y);
            s[0] = (-r[0] - 2.0 * y * r[1]) / determinant;
            s[1] = (2.0 * x * r[1] - r[0]) / determinant;
            return true;
          },
      .check = [&](const NewtonIterate&) { return norm <= 1e-14 ? NewtonVerdict::solved : NewtonVerdict::go_on; },
      .follow_step =
          [&](Vec, Vec to) {
            const VectorReader u(to);
            errors.push_back(std::hypot(u[0] - std::numbers::sqrt2, u[1] - std::numbers::sqrt2));
          }};
  {
    const VectorWriter start(unknown);
    start[0] = 3.0;
    start[1] = 1.0;
  }
  NewtonSolver solver(unknown, std::move(problem), {.steps = HalvedSteps{}, .reuse = never});
  const NewtonOutcome outcome = solver.solve(unknown);
  EXPECT_EQ(outcome.end, NewtonEnd::solved);
  EXPECT_EQ(outcome.status(), io::RunStatus::completed);
  EXPECT_EQ(outcome.iterations, static_cast<int>(errors.size()));
  EXPECT_EQ(outcome.tangents, outcome.iterations);
  ASSERT_GE(errors.size(), 4U);
  // The first step makes x = y; after the third the error is that of rounding.
  EXPECT_NEAR(std::log(errors[2] / errors[1]) / std::log(errors[1] / errors[0]), 2.0, 0.2);
  EXPECT_NEAR(errors[1] / (errors[0] * errors[0]), 1.0 / (4.0 * std::numbers::sqrt2) * std::numbers::sqrt2, 0.06);
  EXPECT_NEAR(VectorReader(unknown)[0], std::numbers::sqrt2, 1e-14);
}

// From 3 the full step of the logarithm ends at -0.3, half of it at 1.35.
TEST(NewtonSolver, HalvesAStepThatLeavesTheDomain) {
  OneEquation equation = logarithm();
  EXPECT_EQ(equation.solve(3.0).end, NewtonEnd::solved);
  EXPECT_NEAR(equation.visited[1], 3.0 - 0.5 * 3.0 * std::log(3.0), 1e-15);
  EXPECT_EQ(equation.evaluations, equation.visited.size() + 1) << "one of a trial that was rejected";
  EXPECT_NEAR(equation.x, 1.0, 1e-12);
}

TEST(NewtonSolver, CorrectsTrialsBeforeTheyAreEvaluated) {
  VectorHandle unknown;
  petsc(VecCreateSeq(MPI_COMM_SELF, 1, unknown.receive()));
  petsc(VecSet(unknown, 5.0));
  double x = 0.0;
  std::vector<double> lengths;
  NewtonProblem problem{.residual =
                            [&](Vec at, Vec residual) {
                              x = VectorReader(at)[0];
                              VectorWriter{residual}[0] = x - 1.0;
                              return x > 2.5 || x == 1.0;
                            },
                        .prepare_tangent = [](Vec) { return true; },
                        .solve_tangent = [](Vec b, Vec y) { return VecCopy(b, y) == 0; },
                        .check = [&](const NewtonIterate&) { return x == 1.0 ? NewtonVerdict::solved : NewtonVerdict::go_on; },
                        .correct_trial =
                            [&](Vec trial, Vec from, double length) {
                              EXPECT_EQ(VectorReader(trial)[0], (1.0 - length) * VectorReader(from)[0] + length);
                              lengths.push_back(length);
                              if (length == 1.0 && VectorReader(from)[0] == 5.0) VectorWriter{trial}[0] = 0.0;
                            }};
  NewtonSolver solver(unknown, std::move(problem), {.steps = HalvedSteps{}, .reuse = never});
  EXPECT_EQ(solver.solve(unknown).end, NewtonEnd::solved);
  EXPECT_EQ(lengths, (std::vector<double>{1.0, 0.5, 1.0}));
}

TEST(NewtonSolver, EndsWithoutAResidualAlongTheStep) {
  OneEquation equation = logarithm();
  equation.function = [](double x) { return x == 3.0 ? std::optional(std::log(x)) : std::nullopt; };
  for (const bool bracketed : {false, true}) {
    OneEquation same;
    same.function = equation.function;
    same.derivative = equation.derivative;
    if (bracketed) same.options.steps = BracketedSteps{};
    const NewtonOutcome outcome = same.solve(3.0);
    EXPECT_EQ(outcome.end, NewtonEnd::no_residual);
    EXPECT_EQ(outcome.status(), io::RunStatus::inverted_element);
    EXPECT_EQ(outcome.iterations, 0);
    EXPECT_EQ(same.x, 3.0);
  }
}

TEST(NewtonSolver, EndsWithoutAResidualAtTheStart) {
  OneEquation equation = logarithm();
  const NewtonOutcome outcome = equation.solve(-1.0);
  EXPECT_EQ(outcome.end, NewtonEnd::no_residual);
  EXPECT_EQ(outcome.tangents, 0);
}

TEST(NewtonSolver, TakesAResidualThatIsNotFiniteForNone) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    OneEquation equation = logarithm();
    equation.function = [value](double x) { return std::optional(x > 0.0 ? std::log(x) : value); };
    EXPECT_EQ(equation.solve(3.0).end, NewtonEnd::solved);
    EXPECT_EQ(equation.solve(-1.0).end, NewtonEnd::no_residual);
  }
}

// Newton's full steps from 2 go -3.5, 14, -280, ...: each further beyond the root.
TEST(NewtonSolver, TurnsBackFromAStepFarBeyondTheRoot) {
  OneEquation equation = arc_tangent();
  equation.options.steps = BracketedSteps{};
  EXPECT_EQ(equation.solve(2.0).end, NewtonEnd::solved);
  EXPECT_LT(std::abs(equation.visited[1]), 1.0);
  EXPECT_NEAR(equation.x, 0.0, 1e-12);
}

TEST(NewtonSolver, EndsAtItsLimitOfIterations) {
  OneEquation equation = arc_tangent();
  equation.options.most_iterations = 3;
  const NewtonOutcome outcome = equation.solve(2.0);
  EXPECT_EQ(outcome.end, NewtonEnd::too_many_iterations);
  EXPECT_EQ(outcome.status(), io::RunStatus::not_converged);
  EXPECT_EQ(outcome.iterations, 3);
  EXPECT_EQ(equation.x, equation.visited.back());
}

TEST(NewtonSolver, ReportsATangentThatCannotBePrepared) {
  OneEquation equation = logarithm();
  equation.can_prepare = false;
  const NewtonOutcome outcome = equation.solve(2.0);
  EXPECT_EQ(outcome.end, NewtonEnd::linear_failure);
  EXPECT_EQ(outcome.status(), io::RunStatus::not_converged);
  EXPECT_EQ(outcome.iterations, 0);
  EXPECT_EQ(equation.x, 2.0);
  equation.can_prepare = true;
  EXPECT_EQ(equation.solve(2.0).end, NewtonEnd::solved) << "a failure must not outlive its solve";
}

TEST(NewtonSolver, ReportsALinearSystemThatCannotBeSolved) {
  OneEquation equation = logarithm();
  equation.after_step = [&] { equation.can_solve = false; };
  const NewtonOutcome outcome = equation.solve(2.0);
  EXPECT_EQ(outcome.end, NewtonEnd::linear_failure);
  EXPECT_EQ(outcome.iterations, 1);
  EXPECT_EQ(equation.x, equation.visited[1]);
  equation.can_solve = true;
  equation.after_step = {};
  EXPECT_EQ(equation.solve(2.0).end, NewtonEnd::solved);
}

TEST(NewtonSolver, EndsWhereTheProblemJudgesThatItDiverges) {
  VectorHandle unknown;
  petsc(VecCreateSeq(MPI_COMM_SELF, 1, unknown.receive()));
  NewtonProblem problem{
      .residual = [](Vec, Vec residual) { return VecSet(residual, 1.0) == 0; },
      .prepare_tangent = [](Vec) { return true; },
      .solve_tangent = [](Vec b, Vec y) { return VecCopy(b, y) == 0; },
      .check = [](const NewtonIterate& iterate) { return iterate.steps < 2 ? NewtonVerdict::go_on : NewtonVerdict::diverging; }};
  NewtonSolver solver(unknown, std::move(problem), {.steps = HalvedSteps{}, .reuse = never});
  const NewtonOutcome outcome = solver.solve(unknown);
  EXPECT_EQ(outcome.end, NewtonEnd::diverging);
  EXPECT_EQ(outcome.status(), io::RunStatus::not_converged);
  EXPECT_EQ(outcome.iterations, 2);
}

TEST(NewtonSolver, StopsBeforeItsFirstStepAndBetweenSteps) {
  std::atomic<bool> stop = true;
  OneEquation equation = logarithm();
  EXPECT_EQ(equation.solve(2.0, &stop).end, NewtonEnd::stopped);
  EXPECT_EQ(equation.x, 2.0);
  stop = false;
  equation.after_step = [&] { stop = equation.visited.size() == 3; };
  const NewtonOutcome outcome = equation.solve(2.0, &stop);
  EXPECT_EQ(outcome.end, NewtonEnd::stopped);
  EXPECT_EQ(outcome.status(), io::RunStatus::stopped);
  EXPECT_EQ(outcome.iterations, 2);
  EXPECT_EQ(equation.x, equation.visited[2]);
}

// x + x^3 / 100 - 1: the tangent at the start does for the whole way; that of the arc tangent at 1.2 does not.
TEST(NewtonSolver, UsesATangentAgainWhileTheResidualFalls) {
  OneEquation equation;
  double residual = 0.0;
  equation.function = [&](double x) { return std::optional(residual = x + 0.01 * x * x * x - 1.0); };
  equation.derivative = [](double x) { return 1.0 + 0.03 * x * x; };
  equation.options.reuse = ReuseWhileResidualFalls{[&] { return std::abs(residual); }, 0.1, 0.2};
  const NewtonOutcome outcome = equation.solve(0.5);
  EXPECT_EQ(outcome.end, NewtonEnd::solved);
  EXPECT_EQ(outcome.tangents, 1);
  EXPECT_GT(outcome.iterations, 3);
  EXPECT_EQ(equation.solve(0.5).tangents, 1) << "each solve begins with a tangent of its own";

  equation.function = [&](double x) { return std::optional(residual = std::atan(x)); };
  equation.derivative = [](double x) { return 1.0 / (1.0 + x * x); };
  EXPECT_GT(equation.solve(1.2).tangents, 3);
}

TEST(NewtonSolver, UsesATangentInTheNextSolvesWhileStepsShrink) {
  OneEquation equation;
  equation.function = [&](double x) { return std::optional(x + 0.01 * x * x * x - 1.0); };
  equation.derivative = [](double x) { return 1.0 + 0.03 * x * x; };
  equation.options.reuse = ReuseWhileStepsShrink{[](Vec step) { return std::abs(VectorReader(step)[0]); }};
  EXPECT_EQ(equation.solve(0.5).tangents, 1);
  EXPECT_EQ(equation.solve(0.6).tangents, 0);
  equation.solver().forget_tangent();
  EXPECT_EQ(equation.solve(0.6).tangents, 1);
  EXPECT_EQ(equation.solver().tangents(), 2);
}

// A full first step would go past the solution by more than it began with. What the shortened one leaves is at least its rest.
TEST(NewtonSolver, CountsWhatAShortenedStepLeaves) {
  OneEquation equation = arc_tangent();
  equation.options.steps = BracketedSteps{};
  equation.options.reuse = ReuseWhileStepsShrink{[](Vec step) { return std::abs(VectorReader(step)[0]); }};
  ASSERT_EQ(equation.solve(2.0).end, NewtonEnd::solved);
  const double step = 5.0 * std::atan(2.0);
  const double length = (2.0 - equation.visited[1]) / step;
  ASSERT_LT(length, 0.8);
  EXPECT_GE(equation.distances[1], (1.0 - length) * step * (1.0 - 1e-12));
}

// With the tangent of the start errors shrink by a constant ratio r, and a step d leaves d r / (1 - r).
TEST(NewtonSolver, EstimatesWhatIsLeftFromTheRatioOfSteps) {
  OneEquation equation;
  equation.function = [](double x) { return std::optional(x - 1.0); };
  equation.derivative = [](double) { return 1.25; };  // r = 0.2
  equation.options.reuse = ReuseWhileStepsShrink{[](Vec step) { return std::abs(VectorReader(step)[0]); }};
  EXPECT_EQ(equation.solve(2.0).end, NewtonEnd::solved);
  EXPECT_EQ(equation.distances[0], std::numeric_limits<double>::infinity());
  for (std::size_t n = 2; n < 8; ++n) EXPECT_NEAR(equation.distances[n] / std::abs(equation.visited[n] - 1.0), 1.0, 1e-4);
}

}  // namespace
}  // namespace menger::fem
