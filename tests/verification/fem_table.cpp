#include "fem_table.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <cstdio>

namespace menger::fem {

namespace {

bool is_first_rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank == 0;
}

}  // namespace

double observed_order(double coarse_error, double fine_error) { return std::log2(std::abs(coarse_error / fine_error)); }

void expect_close(const std::string& what, double computed, double reference, double tolerance) {
  const double error = (computed - reference) / reference;
  if (is_first_rank()) std::printf("| %s | %.7g | %.7g | %.1e | %.0e | |\n", what.c_str(), computed, reference, error, tolerance);
  EXPECT_LE(std::abs(error), tolerance) << what << ": " << computed << " instead of " << reference;
}

void expect_order(const std::string& what, const std::vector<double>& values, double reference, double order, double tolerance) {
  ASSERT_GE(values.size(), 2U);
  std::vector<double> orders;
  std::string text;
  for (std::size_t n = 1; n < values.size(); ++n) {
    orders.push_back(observed_order(values[n - 1] - reference, values[n] - reference));
    char number[32];
    std::snprintf(number, sizeof number, "%s%.2f", n == 1 ? "" : ", ", orders.back());
    text += number;
  }
  const double error = (values.back() - reference) / reference;
  if (is_first_rank())
    std::printf("| %s | %.7g | %.7g | %.1e | order %.2g +- %.2g | %s |\n", what.c_str(), values.back(), reference, error, order,
                tolerance, text.c_str());
  EXPECT_NEAR(orders.back(), order, tolerance) << what;
}

}  // namespace menger::fem
