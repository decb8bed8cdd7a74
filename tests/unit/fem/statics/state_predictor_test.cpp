#include "fem/statics/state_predictor.h"

#include <gtest/gtest.h>

namespace menger::fem {
namespace {

/// A state whose numbers are polynomials of the stated degree in s.
BodyState state_at(double s, int degree) {
  const double square = degree > 1 ? s * s : 0.0;
  const double linear = degree > 0 ? s : 0.0;
  return {{1.0 + 2.0 * linear - square, linear, 3.0 * square, 4.0, 0.5 * linear, -linear},
          {1e3 + 5e2 * linear + 2e2 * square},
          {1e4 * linear, -2e4 + 1e3 * square}};
}

void expect_equal(const BodyState& a, const BodyState& b) {
  for (std::size_t n = 0; n < b.displacements_m.size(); ++n) EXPECT_NEAR(a.displacements_m[n], b.displacements_m[n], 1e-13);
  for (std::size_t n = 0; n < b.plenum_pressures_Pa.size(); ++n)
    EXPECT_NEAR(a.plenum_pressures_Pa[n], b.plenum_pressures_Pa[n], 1e-10);
  ASSERT_EQ(a.element_pressures_Pa.size(), b.element_pressures_Pa.size());
  for (std::size_t n = 0; n < b.element_pressures_Pa.size(); ++n)
    EXPECT_NEAR(a.element_pressures_Pa[n], b.element_pressures_Pa[n], 1e-9);
}

TEST(StatePredictor, ContinuesPolynomialsOfItsOrderExactly) {
  for (const int order : {0, 1, 2}) {
    StatePredictor predictor(order);
    for (const double s : {-0.3, 0.1, 0.2, 0.7}) predictor.add(s, state_at(s, order));
    EXPECT_EQ(predictor.present_order(), order);
    expect_equal(predictor.at(1.1), state_at(1.1, order));
    expect_equal(predictor.at(0.7), state_at(0.7, order));
  }
}

TEST(StatePredictor, LowersItsOrderWhereItHasFewStates) {
  StatePredictor predictor(2);
  predictor.add(0.0, state_at(0.0, 2));
  EXPECT_EQ(predictor.present_order(), 0);
  expect_equal(predictor.at(5.0), state_at(0.0, 2));
  predictor.add(0.5, state_at(0.5, 1));
  EXPECT_EQ(predictor.present_order(), 1);
  predictor.clear();
  predictor.add(0.2, state_at(0.2, 1));
  predictor.add(0.5, state_at(0.5, 1));
  expect_equal(predictor.at(1.0), state_at(1.0, 1));
}

TEST(StatePredictor, TakesALowerOrderIfAsked) {
  StatePredictor predictor(2);
  for (const double s : {0.0, 0.1, 0.3}) predictor.add(s, state_at(s, 2));
  expect_equal(predictor.at(0.4, 0), state_at(0.3, 2));
  const BodyState secant = predictor.at(0.5, 1);
  const BodyState before = state_at(0.1, 2);
  const BodyState last = state_at(0.3, 2);
  for (std::size_t n = 0; n < last.displacements_m.size(); ++n)
    EXPECT_NEAR(secant.displacements_m[n], 2.0 * last.displacements_m[n] - before.displacements_m[n], 1e-13);
}

TEST(StatePredictor, KeepsTheLastThreeStatesForARestart) {
  StatePredictor predictor(1);
  for (const double s : {0.0, 0.1, 0.3, 0.4, 0.9}) predictor.add(s, state_at(s, 2));
  EXPECT_EQ(predictor.path_parameters(), (std::vector{0.3, 0.4, 0.9}));
  ASSERT_EQ(predictor.states().size(), 3U);
  EXPECT_EQ(predictor.last().plenum_pressures_Pa, state_at(0.9, 2).plenum_pressures_Pa);
}

}  // namespace
}  // namespace menger::fem
