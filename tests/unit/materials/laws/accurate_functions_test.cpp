#include "materials/laws/accurate_functions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace menger::materials {
namespace {

/// Arguments of either sign from far below rounding error to beyond the change from series to closed form.
template <class F>
void for_each_argument(double largest, F&& f) {
  for (double x = largest; x > 1e-12; x *= 0.83) {
    f(x);
    f(-x);
  }
}

TEST(AccurateFunctions, LogRemainderKeepsItsDigits) {
  for_each_argument(0.9, [](double x) {
    const long double exact = std::abs(x) > 1e-3 ? static_cast<long double>(x) - std::log1p(static_cast<long double>(x))
                                                 : static_cast<long double>(x) * x *
                                                       (0.5L - static_cast<long double>(x) / 3.0L + x * x * 0.25L -
                                                        x * x * x * 0.2L + x * x * x * x / 6.0L - x * x * x * x * x / 7.0L);
    EXPECT_NEAR(log_remainder(x) / static_cast<double>(exact), 1.0, 4e-15) << x;
  });
  EXPECT_EQ(log_remainder(0.0), 0.0);
}

TEST(AccurateFunctions, SinhcExcessKeepsItsDigits) {
  for_each_argument(20.0, [](double x) {
    const long double y = x;
    const long double exact =
        std::abs(x) > 0.3
            ? std::sinh(y) / y - 1.0L
            : y * y / 6.0L *
                  (1.0L +
                   y * y / 20.0L *
                       (1.0L + y * y / 42.0L * (1.0L + y * y / 72.0L * (1.0L + y * y / 110.0L * (1.0L + y * y / 156.0L)))));
    EXPECT_NEAR(sinhc_excess(x) / static_cast<double>(exact), 1.0, 4e-15) << x;
  });
  EXPECT_EQ(sinhc_excess(0.0), 0.0);
}

TEST(AccurateFunctions, ExpRemainderKeepsItsDigits) {
  for_each_argument(20.0, [](double x) {
    const long double y = x;
    const long double exact =
        std::abs(x) > 1e-2
            ? std::expm1(y) - y
            : y * y * 0.5L *
                  (1.0L +
                   y / 3.0L * (1.0L + y / 4.0L * (1.0L + y / 5.0L * (1.0L + y / 6.0L * (1.0L + y / 7.0L * (1.0L + y / 8.0L))))));
    EXPECT_NEAR(exp_remainder(x) / static_cast<double>(exact), 1.0, 1e-14) << x;
  });
}

}  // namespace
}  // namespace menger::materials
