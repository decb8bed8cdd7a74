#include "voxel/statics/modified_newton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace menger::voxel {
namespace {

using Eigen::SparseMatrix;
using Eigen::VectorXd;
using Values = Equations::Values;

/// Equations in one unknown, and the places at which they are asked for residuals.
class OneEquation {
 public:
  OneEquation(std::function<double(double)> f, std::function<double(double)> slope) : f_(std::move(f)), slope_(std::move(slope)) {
    tangent_.insert(0, 0) = 1.0;
    tangent_.makeCompressed();
  }

  [[nodiscard]] Equations equations() {
    return {[this](const Values& x, Eigen::Ref<VectorXd> residual) {
              places.push_back(x[0]);
              residual[0] = f_(x[0]);
            },
            [this](const Values& x) -> const SparseMatrix<double>& {
              tangent_.coeffRef(0, 0) = slope_(x[0]);
              return tangent_;
            }};
  }

  std::vector<double> places;

 private:
  std::function<double(double)> f_;
  std::function<double(double)> slope_;
  SparseMatrix<double> tangent_{1, 1};
};

constexpr NewtonOptions long_steps{.largest_step = 100.0};

VectorXd at(double x) { return VectorXd::Constant(1, x); }

TEST(ModifiedNewton, FindsARootOfTwoEquations) {
  SparseMatrix<double> tangent = Eigen::MatrixXd::Ones(2, 2).sparseView();
  const Equations circle_and_diagonal{
      [](const Values& x, Eigen::Ref<VectorXd> residual) { residual << x.squaredNorm() - 1.0, x[0] - x[1]; },
      [&tangent](const Values& x) -> const SparseMatrix<double>& {
        tangent = (Eigen::Matrix2d() << 2.0 * x[0], 2.0 * x[1], 1.0, -1.0).finished().sparseView();
        return tangent;
      }};
  ModifiedNewton newton;
  VectorXd x(2);
  x << 1.0, 0.5;
  ASSERT_TRUE(newton.find_root(circle_and_diagonal, x, {}));
  EXPECT_NEAR(x[0], std::sqrt(0.5), 1e-11);
  EXPECT_NEAR(x[1], std::sqrt(0.5), 1e-11);
}

TEST(ModifiedNewton, KeepsTheTangentWhileTheResidualFallsFast) {
  OneEquation gentle([](double x) { return x + 0.02 * x * x - 0.5; }, [](double x) { return 1.0 + 0.04 * x; });
  ModifiedNewton newton;
  VectorXd x = at(0.0);
  ASSERT_TRUE(newton.find_root(gentle.equations(), x, {}));
  EXPECT_NEAR(x[0] + 0.02 * x[0] * x[0], 0.5, 1e-11);
  EXPECT_GT(newton.iteration_count(), 3U);
  EXPECT_EQ(newton.factorisation_count(), 1U);
  x = at(0.1);
  ASSERT_TRUE(newton.find_root(gentle.equations(), x, {}));
  EXPECT_EQ(newton.factorisation_count(), 1U) << "nor does the next search need a new one";
  newton.forget_tangent();
  x = at(0.1);
  ASSERT_TRUE(newton.find_root(gentle.equations(), x, {}));
  EXPECT_EQ(newton.factorisation_count(), 2U);
}

TEST(ModifiedNewton, FormsNewTangentsWhileTheResidualFallsSlowly) {
  OneEquation steep([](double x) { return std::exp(x) - 1.0; }, [](double x) { return std::exp(x); });
  ModifiedNewton newton;
  VectorXd x = at(3.0);
  ASSERT_TRUE(newton.find_root(steep.equations(), x, long_steps));
  EXPECT_NEAR(x[0], 0.0, 1e-11);
  EXPECT_GT(newton.factorisation_count(), 2U);
  EXPECT_LE(newton.factorisation_count(), newton.iteration_count());
}

TEST(ModifiedNewton, FormsANewTangentWhereTheOldOneLeadsAstray) {
  OneEquation rising([](double x) { return x - 1.0; }, [](double) { return 1.0; });
  OneEquation falling([](double x) { return 1.0 - x; }, [](double) { return -1.0; });
  ModifiedNewton newton;
  VectorXd x = at(0.0);
  ASSERT_TRUE(newton.find_root(rising.equations(), x, long_steps));
  x = at(0.0);
  ASSERT_TRUE(newton.find_root(falling.equations(), x, long_steps));
  EXPECT_NEAR(x[0], 1.0, 1e-11);
  EXPECT_EQ(newton.factorisation_count(), 2U);
}

TEST(ModifiedNewton, CutsStepsToTheLargest) {
  OneEquation far([](double x) { return x - 3.0; }, [](double) { return 1.0; });
  ModifiedNewton newton;
  VectorXd x = at(0.0);
  ASSERT_TRUE(newton.find_root(far.equations(), x, {.largest_step = 0.5}));
  EXPECT_EQ(newton.iteration_count(), 6U);
  for (std::size_t i = 1; i < far.places.size(); ++i) EXPECT_LE(far.places[i] - far.places[i - 1], 0.5 + 1e-12);
}

TEST(ModifiedNewton, HalvesStepsThatRaiseTheResidual) {
  OneEquation bent([](double x) { return std::atan(x); }, [](double x) { return 1.0 / (1.0 + x * x); });
  ModifiedNewton newton;
  VectorXd x = at(3.0);
  ASSERT_TRUE(newton.find_root(bent.equations(), x, long_steps));
  EXPECT_NEAR(x[0], 0.0, 1e-11);
  // At the start, at the end of the whole step, at that of half of it.
  const double step = -std::atan(3.0) * 10.0;
  ASSERT_GE(bent.places.size(), 3U);
  EXPECT_NEAR(bent.places[1], 3.0 + step, 1e-12);
  EXPECT_NEAR(bent.places[2], 3.0 + 0.5 * step, 1e-12);
}

TEST(ModifiedNewton, ShortensStepsToWhereThereAreResiduals) {
  OneEquation half_line([](double x) { return std::log(x); }, [](double x) { return 1.0 / x; });
  ModifiedNewton newton;
  VectorXd x = at(4.0);
  ASSERT_TRUE(newton.find_root(half_line.equations(), x, long_steps));
  EXPECT_LT(*std::min_element(half_line.places.begin(), half_line.places.end()), 0.0) << "no step led out of the half line";
  EXPECT_NEAR(x[0], 1.0, 1e-11);
}

TEST(ModifiedNewton, FormsANewTangentWhereTheOldOneLeadsToNoResidual) {
  OneEquation flat([](double x) { return 1e-4 * (x - 1.5); }, [](double) { return 1e-4; });
  OneEquation half_line([](double x) { return std::log(x); }, [](double x) { return 1.0 / x; });
  const NewtonOptions any_step{.largest_step = 1e6};
  ModifiedNewton newton;
  VectorXd x = at(2.0);
  ASSERT_TRUE(newton.find_root(flat.equations(), x, any_step));
  x = at(1.5);
  ASSERT_TRUE(newton.find_root(half_line.equations(), x, any_step));
  EXPECT_LT(*std::min_element(half_line.places.begin(), half_line.places.end()), -100.0) << "the old tangent led nowhere far";
  EXPECT_NEAR(x[0], 1.0, 1e-11);
}

TEST(ModifiedNewton, FindsNothingWhereThereAreNoResiduals) {
  OneEquation point([](double x) { return x == 1.0 ? 1.0 : std::numeric_limits<double>::quiet_NaN(); },
                    [](double) { return 1.0; });
  ModifiedNewton newton;
  VectorXd x = at(1.0);
  EXPECT_FALSE(newton.find_root(point.equations(), x, {}));
  EXPECT_EQ(x[0], 1.0);
  x = at(2.0);
  EXPECT_FALSE(newton.find_root(point.equations(), x, {}));
}

TEST(ModifiedNewton, FindsNothingWhereTheTangentIsSingular) {
  OneEquation flat([](double) { return 1.0; }, [](double) { return 0.0; });
  ModifiedNewton newton;
  VectorXd x = at(1.0);
  EXPECT_FALSE(newton.find_root(flat.equations(), x, {}));
  EXPECT_EQ(x[0], 1.0);
  OneEquation line([](double v) { return v; }, [](double) { return 1.0; });
  EXPECT_TRUE(newton.find_root(line.equations(), x, long_steps)) << "a singular tangent is not kept";
}

TEST(ModifiedNewton, SaysWhereThereIsNoRootAndPrintsNothing) {
  OneEquation above([](double x) { return x * x + 1.0; }, [](double x) { return 2.0 * x; });
  ModifiedNewton newton;
  VectorXd x = at(1.0);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_FALSE(newton.find_root(above.equations(), x, {}));
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
  EXPECT_LE(newton.iteration_count(), 20U);
}

TEST(ModifiedNewton, StopsAtTheLargestNumberOfIterations) {
  OneEquation far([](double x) { return x - 30.0; }, [](double) { return 1.0; });
  ModifiedNewton newton;
  VectorXd x = at(0.0);
  EXPECT_FALSE(newton.find_root(far.equations(), x, {.largest_step = 1.0, .largest_iteration_count = 7}));
  EXPECT_EQ(newton.iteration_count(), 7U);
  EXPECT_NEAR(x[0], 7.0, 1e-12);
  EXPECT_FALSE(newton.find_root(far.equations(), x, {.largest_step = 1.0, .largest_iteration_count = 0}));
  EXPECT_EQ(newton.iteration_count(), 7U);
}

TEST(ModifiedNewton, OfNoEquationsFindsTheRoot) {
  const Equations none{[](const Values&, const Eigen::Ref<VectorXd>&) {}, {}};
  ModifiedNewton newton;
  VectorXd x;
  EXPECT_TRUE(newton.find_root(none, x, {}));
}

}  // namespace
}  // namespace menger::voxel
