#include "voxel/laws/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace menger::voxel {
namespace {

Quaternion<double> about(const Vector3<double>& axis, double angle) {
  const double s = std::sin(angle / 2.0) / std::sqrt(dot(axis, axis));
  return {std::cos(angle / 2.0), s * axis.x, s * axis.y, s * axis.z};
}

TEST(RotationVector, IsExactOnBothSidesOfThePolynomial) {
  for (const double angle : {1e-9, 1e-4, 0.05, 0.3, 0.39, 0.41, 1.0, 3.0, 4.0, 6.0}) {
    const Vector3<double> v = rotation_vector(about({0.0, 3.0, 4.0}, angle));
    EXPECT_NEAR(v.x, 0.0, 1e-16);
    EXPECT_NEAR(v.y / (0.6 * angle), 1.0, 2e-14) << angle;
    EXPECT_NEAR(v.z / (0.8 * angle), 1.0, 2e-14) << angle;
  }
}

TEST(RotationVector, OfAQuaternionJustBeyondUnitLengthIsFinite) {
  const Vector3<double> v = rotation_vector(Quaternion<double>{1.0 + 1e-15, 1e-9, 0.0, 0.0});
  EXPECT_NEAR(v.x, 2e-9, 1e-20);
}

TEST(QuaternionProduct, OfConjugatesAndTurnsIsThatOfAnyTwo) {
  const auto inverse = [](const Quaternion<double>& q) { return Quaternion<double>{q.w, -q.x, -q.y, -q.z}; };
  const auto expect_same = [](const Quaternion<double>& a, const Quaternion<double>& b) {
    EXPECT_EQ(a.w, b.w);
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.y, b.y);
    EXPECT_EQ(a.z, b.z);
  };
  const Quaternion<double> a = about({0.3, -1.0, 2.0}, 0.7);
  const Quaternion<double> b = about({-1.1, 0.4, 0.2}, -1.3);
  const Quaternion<double> turn = rotation_onto_x(Vector3<double>{0.8, -0.3, 0.5});
  expect_same(seen_from(a, b), inverse(a) * b);
  expect_same(turn_times(turn, b), turn * b);
  expect_same(times_inverse_turn(a, turn), a * inverse(turn));
}

TEST(QuaternionOfRotationVector, InvertsTheRotationVector) {
  for (const double angle : {1e-12, 1e-3, 0.19, 0.21, 2.0}) {
    const Vector3<double> back =
        rotation_vector(quaternion_of(Vector3<double>{angle / 3.0, -2.0 * angle / 3.0, 2.0 * angle / 3.0}));
    EXPECT_NEAR(back.x / (angle / 3.0), 1.0, 1e-13) << angle;
    EXPECT_NEAR(back.y / (-2.0 * angle / 3.0), 1.0, 1e-13) << angle;
  }
}

TEST(RotationOntoX, TurnsEveryDirectionOntoXByTheShortestWay) {
  for (const Vector3<double>& d :
       {Vector3<double>{1.0, 0.0, 0.0}, Vector3<double>{0.1, 1.0, -2.0}, Vector3<double>{-1.0, 1e-9, 0.0},
        Vector3<double>{-3.0, 0.0, 0.0}, Vector3<double>{0.0, 0.0, 5.0}}) {
    const Quaternion<double> q = rotation_onto_x(d);
    const Vector3<double> turned = rotate(matrix(q), d);
    const double length = std::sqrt(dot(d, d));
    EXPECT_NEAR(turned.x / length, 1.0, 1e-14);
    EXPECT_NEAR(turned.y / length, 0.0, 1e-14);
    EXPECT_NEAR(turned.z / length, 0.0, 1e-14);
    EXPECT_EQ(q.x, 0.0);
  }
}

TEST(RotationVectorRate, MatchesDifferencesOfTheRotationVector) {
  const Quaternion<double> q = about({1.0, -2.0, 0.5}, 0.3);
  const Vector3<double> spin{0.7, 0.2, -1.1};
  const double step = 1e-6;
  const Vector3<double> later = rotation_vector(quaternion_of(step * spin) * q);
  const Vector3<double> earlier = rotation_vector(quaternion_of(-step * spin) * q);
  const Vector3<double> rate = rotation_vector_rate(rotation_vector(q), spin);
  // The series leaves |v|^4/720 = 1.1e-5 of the spin.
  EXPECT_NEAR(rate.x, (later.x - earlier.x) / (2.0 * step), 2e-5);
  EXPECT_NEAR(rate.y, (later.y - earlier.y) / (2.0 * step), 2e-5);
  EXPECT_NEAR(rate.z, (later.z - earlier.z) / (2.0 * step), 2e-5);
}

TEST(RoundedToSingle, IsTheFloatOfADouble) {
  for (const double x : {0.01, 0.0114471400123, 1.0 / 3.0, 123456.789}) {
    EXPECT_EQ(rounded_to_single(x), static_cast<double>(static_cast<float>(x)));
  }
}

}  // namespace
}  // namespace menger::voxel
