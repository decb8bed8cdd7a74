#include "fem/inflation/inflation_convergence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace menger::fem {
namespace {

/// Results on meshes of sizes 1, 1/2, 1/4, ... whose energy is limit + error size^order.
std::vector<InflationResult> sequence(std::size_t count, double limit, double error, double order) {
  std::vector<InflationResult> results;
  for (std::size_t n = 0; n < count; ++n) {
    InflationResult result;
    result.element_size_m = std::pow(0.5, static_cast<double>(n));
    PathPoint point;
    point.s = 1.0;
    point.strain_energy_J = limit + error * std::pow(result.element_size_m, order);
    result.path.points = {point};
    result.observations = {{}};
    results.push_back(result);
  }
  return results;
}

TEST(Convergence, FindsOrderAndLimitOfAPowerLaw) {
  for (const double order : {0.6, 1.0, 2.0, 3.7}) {
    const auto rows = convergence_rows(sequence(4, 8.0, -0.5, order));
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0].observable, "strain_energy_J");
    EXPECT_FALSE(rows[0].change);
    EXPECT_TRUE(rows[1].change);
    EXPECT_FALSE(rows[1].observed_order) << "two meshes say nothing of the order";
    for (const std::size_t n : {2U, 3U}) {
      ASSERT_TRUE(rows[n].observed_order && rows[n].richardson_estimate);
      EXPECT_NEAR(*rows[n].observed_order, order, 1e-8);  // rounding of values of 8 against changes of 1e-4
      EXPECT_NEAR(*rows[n].richardson_estimate, 8.0, 1e-10);
    }
  }
}

TEST(Convergence, EstimatesNoLimitWhereChangesGrowOrAlternate) {
  const auto growing = convergence_rows(sequence(3, 8.0, -0.5, -1.0));
  EXPECT_LT(growing[2].observed_order.value(), 0.0);
  EXPECT_FALSE(growing[2].richardson_estimate);
  auto results = sequence(3, 8.0, -0.5, 1.0);
  std::swap(results[1], results[2]);
  EXPECT_FALSE(convergence_rows(results)[2].observed_order);
}

TEST(Convergence, ComparesOnlyStatesAtTheSamePathParameter) {
  auto results = sequence(3, 8.0, -0.5, 1.0);
  results[2].path.points.back().s = 0.5;
  EXPECT_EQ(convergence_rows(results).size(), 2U);
  EXPECT_EQ(convergence_table(convergence_rows(results)).row_count(), 2U);
}

}  // namespace
}  // namespace menger::fem
