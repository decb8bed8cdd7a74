#include "voxel/statics/beam_tangent.h"

#include <array>
#include <cstddef>

namespace menger::voxel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Force on the lower end (the force on the upper end is opposite), moment on the lower end, moment on the upper end.
using Loads = Eigen::Matrix<double, 9, 1>;

/// Step of the differences: as a fraction of the voxel edge for lengths, in rad for angles. The rounding error is 1e-16 / 1e-6,
/// the truncation error 1e-12.
constexpr double difference_step = 1e-6;

Loads loads_of(const BeamEnds<double>& ends, bool small, const BeamCoefficients<double>& coefficients) {
  const Rotation<double> frame = matrix(ends.lower);
  const BeamState<double> state = beam_in_state(ends, frame, rotate_back(frame, ends.separation), small);
  const BeamLoads<double> loads = to_world(state.frame, beam_elastic_loads(coefficients, state.deformation, ends.rest_length));
  Loads result;
  result << loads.lower_force.x, loads.lower_force.y, loads.lower_force.z, loads.lower_moment.x, loads.lower_moment.y,
      loads.lower_moment.z, loads.upper_moment.x, loads.upper_moment.y, loads.upper_moment.z;
  return result;
}

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Turns a matrix from axes permuted so that `axis` comes first to axes x, y, z; its columns likewise.
template <class Matrix>
Matrix unpermuted(const Matrix& m, int axis) {
  Matrix result;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    const Eigen::Index row = i - i % 3 + (i % 3 + axis) % 3;
    if constexpr (Matrix::ColsAtCompileTime == 1) {
      result(row) = m(i);
    } else {
      for (Eigen::Index j = 0; j < m.cols(); ++j) result(row, j - j % 3 + (j % 3 + axis) % 3) = m(i, j);
    }
  }
  return result;
}

EndLoads both_ends(const Loads& loads) {
  EndLoads ends;
  ends << loads.head<6>(), -loads.head<3>(), loads.tail<3>();
  return ends;
}

/// Derivatives of the loads in permuted axes.
struct Derivatives {
  Eigen::Matrix<double, 9, 3> separation, upper_rotation;
};

Derivatives differences(const BeamEnds<double>& ends, bool small, const BeamCoefficients<double>& c, double length) {
  Derivatives d;
  const auto slope = [&](auto&& change, double step) -> Loads {
    BeamEnds<double> above = ends;
    BeamEnds<double> below = ends;
    change(above, step);
    change(below, -step);
    return (loads_of(above, small, c) - loads_of(below, small, c)) / (2.0 * step);
  };
  constexpr std::array components{&Vector3<double>::x, &Vector3<double>::y, &Vector3<double>::z};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const auto component = components[i];
    d.separation.col(column) =
        slope([component](BeamEnds<double>& e, double step) { e.separation.*component += step; }, difference_step * length);
    d.upper_rotation.col(column) = slope(
        [component](BeamEnds<double>& e, double step) {
          Vector3<double> turn{0.0, 0.0, 0.0};
          turn.*component = step;
          e.upper = quaternion_of(turn) * e.upper;
        },
        difference_step);
  }
  return d;
}

}  // namespace

BeamEnds<double> beam_ends(const Pose& lower, const Pose& upper, int axis, double rest_length_m,
                           const std::array<double, 2>& half_kink) {
  const auto permuted = [axis](double x, double y, double z) -> Vector3<double> {
    if (axis == 0) return {x, y, z};
    if (axis == 1) return {y, z, x};
    return {z, x, y};
  };
  const auto turned = [&permuted](const Quaternion<double>& q) -> Quaternion<double> {
    const Vector3<double> v = permuted(q.x, q.y, q.z);
    return {q.w, v.x, v.y, v.z};
  };
  const Vector3<double> d = upper.position - lower.position;
  BeamEnds<double> ends{permuted(d.x, d.y, d.z), turned(lower.orientation), turned(upper.orientation), rest_length_m};
  if (half_kink != std::array{0.0, 0.0}) kink(ends, half_kink[0], half_kink[1]);
  return ends;
}

EndLoads beam_end_loads(const BeamEnds<double>& ends, bool small, const BeamCoefficients<double>& coefficients, int axis) {
  return unpermuted(both_ends(loads_of(ends, small, coefficients)), axis);
}

BeamTangent beam_tangent(const BeamEnds<double>& ends, bool small, const BeamCoefficients<double>& coefficients, int axis,
                         double length_m) {
  const Loads loads = loads_of(ends, small, coefficients);
  const Derivatives d = differences(ends, small, coefficients, length_m);
  // A rotation w of the whole beam turns the separation by w x d, both ends by w, and every load f by w x f.
  const Matrix3d turned_separation = cross_matrix({ends.separation.x, ends.separation.y, ends.separation.z});
  Eigen::Matrix<double, 9, 3> lower_rotation = d.separation * turned_separation - d.upper_rotation;
  for (Eigen::Index part = 0; part < 9; part += 3) lower_rotation.middleRows<3>(part) -= cross_matrix(loads.segment<3>(part));
  Eigen::Matrix<double, 9, 12> slopes;
  slopes << -d.separation, lower_rotation, d.separation, d.upper_rotation;
  Eigen::Matrix<double, 12, 12> stiffness;
  stiffness << -slopes.topRows<6>(), slopes.topRows<3>(), -slopes.bottomRows<3>();
  return {.loads = unpermuted(both_ends(loads), axis), .stiffness = unpermuted(stiffness, axis)};
}

}  // namespace menger::voxel
