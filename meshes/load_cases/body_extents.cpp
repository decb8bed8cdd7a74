#include "meshes/load_cases/body_extents.h"

#include <Eigen/Dense>

namespace menger::meshes {
namespace {

using Points = Eigen::Matrix<double, 3, 6>;

constexpr int largest_iteration_count = 1000;
constexpr double converged = 1e-14;  ///< largest change of an entry of the rotation at convergence

Points about_mean(const EndPoints& ends) {
  Points points;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& end = ends[axis][side];
      points.col(static_cast<Eigen::Index>(2 * axis + side)) = Eigen::Vector3d(end[0], end[1], end[2]);
    }
  }
  const Eigen::Vector3d mean = points.rowwise().mean();
  return points.colwise() - mean;
}

/// Returns the rotation that moves `from` closest to `to`, after Kabsch.
Eigen::Matrix3d best_rotation(const Points& from, const Points& to) {
  const Eigen::Matrix3d products = to * from.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const bool is_reflection = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0;
  const Eigen::Vector3d signs(1.0, 1.0, is_reflection ? -1.0 : 1.0);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

/// Computes the rotation of rotation_of_body for points about their mean.
Eigen::Matrix3d rotation_beside_stretch(const Points& X, const Points& x) {
  Eigen::Matrix3d rotation = best_rotation(X, x);
  for (int iteration = 0; iteration < largest_iteration_count; ++iteration) {
    // Alternates between the best stretches for the rotation and the best rotation for the stretches; each step reduces the
    // error.
    const Points turned_back = rotation.transpose() * x;
    const Eigen::Vector3d stretches = turned_back.cwiseProduct(X).rowwise().sum().cwiseQuotient(X.rowwise().squaredNorm());
    const Eigen::Matrix3d next = best_rotation(stretches.asDiagonal() * X, x);
    const double change = (next - rotation).cwiseAbs().maxCoeff();
    rotation = next;
    if (change < converged) break;
  }
  return rotation;
}

}  // namespace

std::array<std::array<double, 3>, 3> rotation_of_body(const EndPoints& reference, const EndPoints& deformed) {
  const Eigen::Matrix3d rotation = rotation_beside_stretch(about_mean(reference), about_mean(deformed));
  std::array<std::array<double, 3>, 3> entries{};
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 3; ++column)
      entries[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = rotation(row, column);
  return entries;
}

std::array<double, 3> extents_without_rotation(const EndPoints& reference, const EndPoints& deformed) {
  const Points x = about_mean(deformed);
  const Eigen::Matrix3d rotation = rotation_beside_stretch(about_mean(reference), x);
  std::array<double, 3> extents{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d between = x.col(2 * axis + 1) - x.col(2 * axis);
    extents[static_cast<std::size_t>(axis)] = rotation.col(axis).dot(between);
  }
  return extents;
}

}  // namespace menger::meshes
