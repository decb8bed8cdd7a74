#include "voxel/laws/beam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "voxel/engine/voxel_classes.h"

namespace menger::voxel {
namespace {

constexpr double edge = 0.01;

BeamCoefficients<double> coefficients() { return class_tables(Physics{}, edge).beam[0]; }

/// The eight numbers of a deformation, in an order of our own.
using Numbers = std::array<double, 8>;

BeamDeformation<double> deformation(const Numbers& n) { return {{n[0], n[1], n[2]}, n[3], n[4], {n[5], n[6], n[7]}}; }

TEST(BeamElasticLoads, AreTheGradientOfTheEnergy) {
  const BeamCoefficients<double> c = coefficients();
  const Numbers at{3e-4, -2e-4, 1e-4, 0.02, -0.03, 0.05, 0.01, -0.04};
  const BeamLoads<double> loads = beam_elastic_loads(c, deformation(at), edge);
  const std::array<double, 8> expected{loads.lower_force.x,   loads.lower_force.y,   loads.lower_force.z,
                                       -loads.lower_moment.y, -loads.lower_moment.z, -loads.upper_moment.x,
                                       -loads.upper_moment.y, -loads.upper_moment.z};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double step = i < 3 ? 1e-6 : 1e-4;
    Numbers above = at;
    Numbers below = at;
    above[i] += step;
    below[i] -= step;
    const double slope = (beam_energy(c, deformation(above), edge) - beam_energy(c, deformation(below), edge)) / (2.0 * step);
    EXPECT_NEAR(slope, expected[i], 1e-9 * c.shear * edge) << i;
  }
}

TEST(BeamElasticLoads, BalanceForceAndMomentOfTheUndeformedLength) {
  const BeamLoads<double> loads =
      beam_elastic_loads(coefficients(), deformation({0.0, 2e-4, -3e-4, 0.02, 0.01, 0.0, -0.03, 0.05}), edge);
  EXPECT_NEAR(loads.lower_force.y + loads.upper_force.y, 0.0, 1e-18);
  EXPECT_NEAR(loads.lower_moment.z + loads.upper_moment.z + edge * loads.upper_force.y, 0.0, 1e-17);
  EXPECT_NEAR(loads.lower_moment.y + loads.upper_moment.y - edge * loads.upper_force.z, 0.0, 1e-17);
}

TEST(BeamElasticLoads, TurnALongerBeamByTheForceTimesTheChangeOfLength) {
  // In the large-angle state the line between the ends is the x axis, and what is left of the moments is (length - edge) x force.
  const double rest = 1.14 * edge;
  const double length = 1.12 * edge;
  const BeamLoads<double> loads =
      beam_elastic_loads(coefficients(), deformation({length - rest, 0.0, 0.0, 0.02, 0.01, 0.0, -0.03, 0.05}), rest);
  const double net_y = loads.lower_moment.y + loads.upper_moment.y - length * loads.upper_force.z;
  const double net_z = loads.lower_moment.z + loads.upper_moment.z + length * loads.upper_force.y;
  EXPECT_NEAR(net_y, -(length - edge) * loads.upper_force.z, 1e-17);
  EXPECT_NEAR(net_z, (length - edge) * loads.upper_force.y, 1e-17);
  EXPECT_GT(std::hypot(net_y, net_z), 1e-2 * coefficients().turn * 0.05);
}

/// Ends of a beam whose lower voxel is turned by `lower`, whose upper one by `upper`, at a separation.
BeamEnds<double> ends(const Vector3<double>& separation, const Vector3<double>& lower, const Vector3<double>& upper) {
  return {separation, quaternion_of(lower), quaternion_of(upper), edge};
}

/// A beam that is driven to another length, sheared and bent.
BeamEnds<double> driven_ends(double rest_length) {
  BeamEnds<double> driven = ends({1.11 * edge, 0.03 * edge, -0.02 * edge}, {0.01, -0.02, 0.015}, {0.03, 0.01, -0.04});
  driven.rest_length = rest_length;
  return driven;
}

/// What is left over of the moments on both ends and those of the forces, about the lower end: zero if they balance.
Vector3<double> net_moment(const BeamEnds<double>& ends, const BeamState<double>& state, const BeamLoads<double>& in_frame) {
  const BeamLoads<double> loads = to_world(state.frame, in_frame);
  return loads.lower_moment + loads.upper_moment + cross(ends.separation, loads.upper_force);
}

double size(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

TEST(BeamDamping, LeavesHalfOfTheMomentOfItsForceAtAnyLength) {
  // Shear of an undriven beam without rotation: the moments on both ends are a quarter of force times length each.
  BeamCoefficients<double> c = coefficients();
  c.damping_lower = c.damping_upper = 1e-3;
  const BeamLoads<double> loads = beam_damping(c, deformation({0.0, 0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}));
  const double net = loads.lower_moment.z + loads.upper_moment.z + edge * loads.upper_force.y;
  EXPECT_NEAR(net, 0.5 * edge * loads.upper_force.y, 1e-12 * std::abs(net));
  EXPECT_NE(net, 0.0);
}

TEST(BalancedBeam, IsPushedAndTurnedByNothing) {
  BeamCoefficients<double> c = coefficients();
  c.damping_lower = c.damping_upper = 1e-3;
  for (const double rest : {0.86 * edge, edge, 1.14 * edge}) {
    const BeamEnds<double> driven = driven_ends(rest);
    const BeamState<double> state = balanced_state(driven);
    const BeamDeformation<double> rate = deformation({0.01, 0.0, 0.0, 0.3, 0.1, 0.2, -0.4, 0.5});
    for (const BeamLoads<double>& published : {beam_elastic_loads(c, state.deformation, rest), beam_damping(c, rate)}) {
      const BeamLoads<double> loads = balanced(published, state, rest);
      const double scale = size(loads.upper_moment);
      EXPECT_GT(size(net_moment(driven, state, published)), 1e-2 * scale);
      EXPECT_LT(size(net_moment(driven, state, loads)), 1e-13 * scale);
      EXPECT_LT(size(loads.lower_force + loads.upper_force) * edge, 1e-13 * scale);
    }
  }
}

TEST(BalancedBeam, HasTheElasticLoadsOfAnUndrivenBeam) {
  const BeamEnds<double> undriven = ends({edge, 0.0, 0.0}, {0.0, -0.02, 0.015}, {0.03, 0.01, -0.04});
  const BeamState<double> state = balanced_state(undriven);
  const BeamLoads<double> published = beam_elastic_loads(coefficients(), state.deformation, edge);
  const BeamLoads<double> loads = balanced(published, state, edge);
  EXPECT_NEAR(loads.upper_force.y, published.upper_force.y, 1e-14 * std::abs(published.upper_force.y));
  EXPECT_NEAR(loads.upper_force.z, published.upper_force.z, 1e-14 * std::abs(published.upper_force.z));
}

TEST(BalancedBeam, DoesNotKnowWhichOfItsEndsIsTheLowerOne) {
  // Turned by half a turn about z, the lower end becomes the upper one. The twist is measured from the lower end, which makes a
  // difference of second order in the angles, 0.04: 1 %. Published moments of a driven beam differ by more than 10 %.
  const BeamCoefficients<double> c = coefficients();
  const double rest = 1.14 * edge;
  const BeamEnds<double> driven = driven_ends(rest);
  const Quaternion<double> half_turn = quaternion_of(Vector3<double>{0.0, 0.0, std::acos(-1.0)});
  const Vector3<double> back = rotate(matrix(half_turn), driven.separation);
  // The axes of both ends are turned with the beam and turned back, so that undeformed ends point along +x again.
  const BeamEnds<double> renamed{-back, half_turn * driven.upper * half_turn, half_turn * driven.lower * half_turn, rest};
  const auto loads_on = [&](const BeamEnds<double>& ends) {
    const BeamState<double> state = balanced_state(ends);
    return to_world(state.frame, balanced(beam_elastic_loads(c, state.deformation, rest), state, rest));
  };
  const BeamLoads<double> one = loads_on(driven);
  const BeamLoads<double> other = loads_on(renamed);
  const auto turned = [&](const Vector3<double>& v) { return rotate(matrix(half_turn), v); };
  EXPECT_LT(size(turned(one.upper_force) - other.lower_force), 0.02 * size(one.upper_force));
  EXPECT_LT(size(turned(one.upper_moment) - other.lower_moment), 0.02 * size(one.upper_moment));
  EXPECT_LT(size(turned(one.lower_moment) - other.upper_moment), 0.02 * size(one.lower_moment));
  const auto published_on = [&](const BeamEnds<double>& ends) {
    const Rotation<double> frame = matrix(ends.lower);
    const BeamState<double> state = beam_in_state(ends, frame, rotate_back(frame, ends.separation), true);
    return to_world(state.frame, beam_elastic_loads(c, state.deformation, rest));
  };
  const BeamLoads<double> published = published_on(driven);
  EXPECT_GT(size(turned(published.upper_moment) - published_on(renamed).lower_moment), 0.1 * size(published.upper_moment));
}

TEST(BalancedBeam, HasTheLoadsThatItsEnergyGives) {
  // Derivatives of the energy by the poses of both ends. Rotation vectors add only to first order: angles of 0.05 leave 2 %.
  const BeamCoefficients<double> c = coefficients();
  const double rest = 1.14 * edge;
  const auto energy = [&](const BeamEnds<double>& at) { return beam_energy(c, balanced_state(at).deformation, rest); };
  const BeamEnds<double> driven = driven_ends(rest);
  const BeamState<double> state = balanced_state(driven);
  const BeamLoads<double> published = to_world(state.frame, beam_elastic_loads(c, state.deformation, rest));
  const BeamLoads<double> loads = to_world(state.frame, balanced(beam_elastic_loads(c, state.deformation, rest), state, rest));
  const double scale = size(loads.lower_moment);
  double published_error = 0.0;
  for (const auto component : {&Vector3<double>::x, &Vector3<double>::y, &Vector3<double>::z}) {
    const auto slope = [&](auto&& change, double step) {
      BeamEnds<double> above = driven;
      BeamEnds<double> below = driven;
      change(above, step);
      change(below, -step);
      return (energy(above) - energy(below)) / (2.0 * step);
    };
    const auto turned = [component](const Quaternion<double>& end, double angle) {
      Vector3<double> turn{0.0, 0.0, 0.0};
      turn.*component = angle;
      return quaternion_of(turn) * end;
    };
    const double force = -slope([component](BeamEnds<double>& e, double step) { e.separation.*component += step; }, 1e-8);
    const double upper = -slope([&](BeamEnds<double>& e, double angle) { e.upper = turned(e.upper, angle); }, 1e-6);
    const double lower = -slope([&](BeamEnds<double>& e, double angle) { e.lower = turned(e.lower, angle); }, 1e-6);
    EXPECT_NEAR(loads.upper_force.*component, force, 0.02 * scale / edge);
    EXPECT_NEAR(loads.upper_moment.*component, upper, 0.02 * scale);
    EXPECT_NEAR(loads.lower_moment.*component, lower, 0.02 * scale);
    published_error = std::max(published_error, std::abs(published.upper_force.*component - force));
  }
  EXPECT_GT(published_error, 0.05 * scale / edge);
}

TEST(BeamState, SwitchesWithHysteresis) {
  const auto is_small = [](double turn, double stretch, double was_small) {
    const double x = edge * (1.0 + stretch);
    return published_state(ends({x, turn * x, 0.0}, {0, 0, 0}, {0, 0, 0}), was_small).small;
  };
  EXPECT_TRUE(is_small(0.055, 0.0, 1.0));
  EXPECT_FALSE(is_small(0.055, 0.0, 0.0));
  EXPECT_FALSE(is_small(0.061, 0.0, 1.0));
  EXPECT_TRUE(is_small(0.049, 0.0, 0.0));
  EXPECT_TRUE(is_small(0.0, 0.55, 1.0));
  EXPECT_FALSE(is_small(0.0, 0.55, 0.0));
  EXPECT_FALSE(is_small(0.0, 0.61, 1.0));
  EXPECT_FALSE(is_small(0.0, -0.61, 1.0));
}

TEST(BeamState, IsTheSameHoweverTheWholeBeamIsTurned) {
  const Vector3<double> separation{0.0103, 0.0009, -0.0004};
  const Vector3<double> lower{0.02, -0.01, 0.03};
  const Vector3<double> upper{-0.05, 0.04, 0.1};
  const BeamState<double> straight = published_state(ends(separation, lower, upper), 0.0);
  const Quaternion<double> turn = quaternion_of(Vector3<double>{0.9, -1.3, 0.4});
  BeamEnds<double> turned_ends = ends(rotate(matrix(turn), separation), lower, upper);
  turned_ends.lower = turn * turned_ends.lower;
  turned_ends.upper = turn * turned_ends.upper;
  const BeamState<double> turned = published_state(turned_ends, 0.0);
  EXPECT_FALSE(straight.small);
  EXPECT_NEAR(turned.deformation.displacement.x, straight.deformation.displacement.x, 1e-16);
  EXPECT_NEAR(turned.deformation.lower_angle_z, straight.deformation.lower_angle_z, 1e-14);
  EXPECT_NEAR(turned.deformation.upper_angle.x, straight.deformation.upper_angle.x, 1e-14);
  const Vector3<double> expected = rotate(matrix(turn), rotate(straight.frame, Vector3<double>{1.0, 2.0, 3.0}));
  const Vector3<double> seen = rotate(turned.frame, Vector3<double>{1.0, 2.0, 3.0});
  EXPECT_NEAR(seen.x, expected.x, 1e-13);
  EXPECT_NEAR(seen.y, expected.y, 1e-13);
  EXPECT_NEAR(seen.z, expected.z, 1e-13);
}

/// Ends of a beam whose halves are at an angle in its middle, with no load on them.
BeamEnds<double> kinked_ends(double half_y, double half_z) {
  const Vector3<double> half{0.0, half_y, half_z};
  const Quaternion<double> turn = quaternion_of(Vector3<double>{0.4, -0.7, 1.1});
  // Either half turns the line between the ends by half the kink.
  return {rotate(matrix(turn * quaternion_of(half)), Vector3<double>{edge, 0.0, 0.0}), turn,
          turn * quaternion_of(half) * quaternion_of(half), edge};
}

TEST(BeamKink, IsTheShapeWithoutLoads) {
  const double half_y = 0.11;
  const double half_z = -0.07;
  for (const double small : {0.0, 1.0}) {
    BeamEnds<double> ends = kinked_ends(half_y, half_z);
    kink(ends, half_y, half_z);
    const Rotation<double> frame = matrix(ends.lower);
    const BeamState<double> state = beam_in_state(ends, frame, rotate_back(frame, ends.separation), small > 0.5);
    const BeamLoads<double> loads = beam_elastic_loads(coefficients(), state.deformation, edge);
    for (const Vector3<double>& load : {loads.lower_force, loads.upper_force})
      EXPECT_LT(std::sqrt(dot(load, load)), 1e-12 * coefficients().shear * edge) << small;
    for (const Vector3<double>& load : {loads.lower_moment, loads.upper_moment})
      EXPECT_LT(std::sqrt(dot(load, load)), 1e-12 * coefficients().turn) << small;
  }
}

TEST(BeamKink, TakesTheWorkThatItsMomentsDo) {
  // The ends stay where they are while the kink changes: the energy changes by the moments of both ends against it.
  const BeamCoefficients<double> c = coefficients();
  const auto at = [&](double half_y, double half_z) {
    BeamEnds<double> bent = ends({edge, 2e-5, -1e-5}, {0.002, -0.003, 0.001}, {0.006, 0.002, -0.005});
    kink(bent, half_y, half_z);
    return bent;
  };
  const auto energy = [&](const BeamEnds<double>& bent) { return beam_energy(c, published_state(bent, 1.0).deformation, edge); };
  const BeamEnds<double> now = at(0.001, 0.002);
  const BeamState<double> state = published_state(now, 1.0);
  ASSERT_TRUE(state.small);
  const BeamLoads<double> loads = to_world(state.frame, beam_elastic_loads(c, state.deformation, edge));
  const Vector3<double> moment =
      rotate_back(matrix(now.lower), loads.lower_moment) - rotate_back(matrix(now.upper), loads.upper_moment);
  const double step = 1e-6;
  const double slope_z = (energy(at(0.001, 0.002 + step)) - energy(at(0.001, 0.002 - step))) / (2.0 * step);
  const double slope_y = (energy(at(0.001 + step, 0.002)) - energy(at(0.001 - step, 0.002))) / (2.0 * step);
  // The small-angle state leaves out terms of the order of the angles, 0.005.
  const double all = std::hypot(slope_y, slope_z);
  EXPECT_GT(all, 1e-3 * c.turn * 0.005);
  EXPECT_NEAR(-moment.z, slope_z, 0.01 * all);
  EXPECT_NEAR(-moment.y, slope_y, 0.01 * all);
}

/// Rates of a deformation from velocities against central differences along the motion that these velocities make.
void expect_rates_match(double was_small, const Vector3<double>& separation, bool small) {
  const Vector3<double> lower{0.02, -0.03, 0.01};
  const Vector3<double> upper{0.06, 0.02, -0.05};
  const BeamEndRates<double> rates{{0.1, -0.2, 0.05}, {-0.15, 0.3, 0.1}, {2.0, -1.0, 3.0}, {-1.0, 4.0, 0.5}, 0.03};
  const auto at = [&](double time) {
    BeamEnds<double> moved = ends(separation + time * (rates.upper_velocity - rates.lower_velocity), lower, upper);
    moved.lower = quaternion_of(time * rates.lower_spin) * moved.lower;
    moved.upper = quaternion_of(time * rates.upper_spin) * moved.upper;
    moved.rest_length = edge + time * rates.rest_length_rate;
    return moved;
  };
  const double step = 1e-7;
  const BeamState<double> now = published_state(at(0.0), was_small);
  ASSERT_EQ(now.small, small);
  const BeamDeformation<double> later = published_state(at(step), was_small).deformation;
  const BeamDeformation<double> earlier = published_state(at(-step), was_small).deformation;
  const BeamDeformation<double> rate = rate_from_velocities(now, at(0.0), rates);
  const double per = 1.0 / (2.0 * step);
  EXPECT_NEAR(rate.displacement.x, per * (later.displacement.x - earlier.displacement.x), 1e-6);
  EXPECT_NEAR(rate.displacement.y, per * (later.displacement.y - earlier.displacement.y), 1e-6);
  EXPECT_NEAR(rate.displacement.z, per * (later.displacement.z - earlier.displacement.z), 1e-6);
  EXPECT_NEAR(rate.lower_angle_y, per * (later.lower_angle_y - earlier.lower_angle_y), 1e-3);
  EXPECT_NEAR(rate.lower_angle_z, per * (later.lower_angle_z - earlier.lower_angle_z), 1e-3);
  EXPECT_NEAR(rate.upper_angle.x, per * (later.upper_angle.x - earlier.upper_angle.x), 1e-3);
  EXPECT_NEAR(rate.upper_angle.y, per * (later.upper_angle.y - earlier.upper_angle.y), 1e-3);
  EXPECT_NEAR(rate.upper_angle.z, per * (later.upper_angle.z - earlier.upper_angle.z), 1e-3);
}

// Angular rates are of size 100 rad/s (velocity over length): 1e-3 is 1e-5 of them.
TEST(BeamRates, FromVelocitiesMatchDifferencesInTheSmallAngleState) { expect_rates_match(1.0, {0.0101, 0.0001, 0.0002}, true); }

TEST(BeamRates, FromVelocitiesMatchDifferencesInTheLargeAngleState) { expect_rates_match(0.0, {0.0101, 0.0012, -0.0009}, false); }

TEST(BeamRates, OfAKinkMatchDifferences) {
  const double rate_y = 3.0;
  const double rate_z = -2.0;
  const auto at = [&](double time) {
    BeamEnds<double> kinked = ends({0.0101, 0.0001, 0.0002}, {0.02, -0.03, 0.01}, {0.06, 0.02, -0.05});
    kink(kinked, time * rate_y, time * rate_z);
    return kinked;
  };
  BeamEndRates<double> rates{};
  add_kink_rate(rates, at(0.0), rate_y, rate_z);
  const double step = 1e-7;
  const BeamDeformation<double> rate = rate_from_velocities(published_state(at(0.0), 1.0), at(0.0), rates);
  const BeamDeformation<double> later = published_state(at(step), 1.0).deformation;
  const BeamDeformation<double> earlier = published_state(at(-step), 1.0).deformation;
  EXPECT_NEAR(rate.displacement.y, (later.displacement.y - earlier.displacement.y) / (2.0 * step), 1e-6);
  EXPECT_NEAR(rate.displacement.z, (later.displacement.z - earlier.displacement.z) / (2.0 * step), 1e-6);
  EXPECT_NEAR(rate.upper_angle.y, (later.upper_angle.y - earlier.upper_angle.y) / (2.0 * step), 1e-3);
  EXPECT_NEAR(rate.upper_angle.z, (later.upper_angle.z - earlier.upper_angle.z) / (2.0 * step), 1e-3);
}

TEST(BeamDamping, TakesEnergyFromEveryRate) {
  const BeamCoefficients<double> c = coefficients();
  for (std::size_t i = 0; i < 8; ++i) {
    Numbers n{};
    n[i] = 1.0;
    const BeamDeformation<double> rate = deformation(n);
    const BeamLoads<double> loads = beam_damping(c, rate);
    const double power = -dot(loads.lower_force, rate.displacement) + loads.lower_moment.y * rate.lower_angle_y +
                         loads.lower_moment.z * rate.lower_angle_z + dot(loads.upper_moment, rate.upper_angle);
    EXPECT_LT(power, 0.0) << i;
  }
}

}  // namespace
}  // namespace menger::voxel
