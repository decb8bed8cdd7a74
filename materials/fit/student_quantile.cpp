#include "materials/fit/student_quantile.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace menger::materials {
namespace {

/// The probability that |t| is smaller than sqrt(freedom) tan(angle): for whole degrees of freedom its density is a power of the
/// cosine of that angle, whose integral is a finite sum.
double probability_within(double angle, int freedom) {
  const double c2 = std::cos(angle) * std::cos(angle);
  const bool odd = freedom % 2 == 1;
  double term = odd ? std::cos(angle) : 1.0;
  double sum = 0.0;
  for (int k = odd ? 3 : 2; k <= freedom; k += 2) {
    sum += term;
    term *= c2 * (k - 1) / k;
  }
  sum *= std::sin(angle);
  return odd ? 2.0 / std::numbers::pi * (angle + sum) : sum;
}

/// Expansion about the normal quantile to the third order of 1 / freedom.
double quantile_of_many(double freedom) {
  const double z = 1.959963984540054;
  const double z2 = z * z;
  const double first = z * (z2 + 1.0) / 4.0;
  const double second = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double third = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  return z + (first + (second + third / freedom) / freedom) / freedom;
}

}  // namespace

double student_quantile_95(int freedom) {
  assert(freedom >= 1);
  constexpr int many = 200;  // from here on the expansion is exact to 1e-8
  if (freedom >= many) return quantile_of_many(freedom);
  double low = 0.0;
  double high = 0.5 * std::numbers::pi;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (low + high);
    (probability_within(middle, freedom) < 0.95 ? low : high) = middle;
  }
  return std::sqrt(freedom) * std::tan(low);
}

}  // namespace menger::materials
