#include "voxel/statics/vibration.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace menger::voxel {
namespace {

/// Derivative of the scaled residual with respect to the pressure of all chambers, by central differences.
Eigen::VectorXd pressure_slope(ForceBalance& balance, const Equilibrium& equilibrium) {
  // The step is so small that the curvature of the laws does not matter.
  const SurrogateParameters& parameters = balance.body().parameters;
  double rate = parameters.plate_draw_in > 0.0 ? parameters.plate_draw_in_per_Pa : 0.0;
  for (const auto& laws : {parameters.extension, parameters.bulge}) {
    for (const PressureLaw& law : laws)
      rate = std::max({rate, std::abs(law.slope_per_Pa), std::abs(law.pressure_softening_per_Pa),
                       std::abs(law.vacuum_softening_per_Pa), law.fading_per_Pa});
  }
  if (rate == 0.0) return Eigen::VectorXd::Zero(balance.unknown_count());
  const double step = 1e-5 / rate;
  const auto residual_at = [&](double change) {
    StaticLoads loads = equilibrium.loads();
    for (double& pressure : loads.pressures_Pa) pressure += change;
    const bool in_range = balance.set_loads(loads);
    return in_range ? balance.residual(equilibrium.state()) : Eigen::VectorXd::Zero(balance.unknown_count()).eval();
  };
  return (residual_at(step) - residual_at(-step)) / (2.0 * step);
}

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

/// The six rigid motions about the middle of the free voxels, in scaled unknowns.
Eigen::MatrixXd rigid_motions(const ForceBalance& balance, const StaticState& state) {
  const StaticBody& body = balance.body();
  Vector3<double> middle{0.0, 0.0, 0.0};
  for (std::size_t voxel = 0; voxel < body.voxel_count(); ++voxel)
    middle = middle + (1.0 / static_cast<double>(body.voxel_count())) * state.poses[voxel].position;
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(balance.unknown_count(), 6);
  for (std::size_t voxel = 0; voxel < body.voxel_count(); ++voxel) {
    const auto at = balance.first_unknown(voxel);
    if (!at) continue;
    const Vector3<double> arm = (1.0 / body.edge_m) * (state.poses[voxel].position - middle);
    motions.block<6, 6>(*at, 0).setIdentity();
    motions.block<3, 3>(*at, 3) << 0.0, arm.z, -arm.y, -arm.z, 0.0, arm.x, arm.y, -arm.x, 0.0;
  }
  return motions;
}

/// The rigid motions to which a tangent responds with no load, in scaled unknowns.
Eigen::MatrixXd unresisted(const Eigen::MatrixXd& tangent, const Eigen::MatrixXd& rigid) {
  constexpr double no_load = 1e-7;
  if (tangent.rows() < rigid.cols()) return Eigen::MatrixXd::Zero(tangent.rows(), 0);
  const Eigen::MatrixXd basis = orthonormal(rigid);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(tangent * basis, Eigen::ComputeThinV);
  // A single voxel without beams resists no motion.
  const double smallest = no_load * std::max(tangent.norm(), std::numeric_limits<double>::min());
  const Eigen::Index count = (svd.singularValues().array() <= smallest).count();
  return basis * svd.matrixV().rightCols(count);
}

}  // namespace

SmallMotion small_motion(const Equilibrium& equilibrium, const Supports& supports) {
  const StaticBody& body = equilibrium.balance().body();
  ForceBalance balance(body, supports);
  static_cast<void>(balance.set_loads(equilibrium.loads()));  // in range, there is an equilibrium
  static_cast<void>(balance.linearise(equilibrium.state()));
  const Eigen::MatrixXd tangent(balance.stiffness());
  const double norm = tangent.norm();
  // From scaled unknowns and residuals (see ForceBalance) to metres, newtons and newton metres.
  const double edge = body.edge_m;
  const double work = balance.force_scale_N() * edge;
  const Eigen::VectorXd per_unknown =
      Eigen::VectorXd::NullaryExpr(tangent.rows(), [edge](Eigen::Index i) { return i % 6 < 3 ? 1.0 / edge : 1.0; });
  SmallMotion motion;
  motion.asymmetry = norm > 0.0 ? (0.5 * (tangent - tangent.transpose())).norm() / norm : 0.0;
  motion.stiffness = work * (per_unknown.asDiagonal() * (0.5 * (tangent + tangent.transpose())) * per_unknown.asDiagonal());
  motion.mass = work * per_unknown.cwiseAbs2().cwiseProduct(balance.masses());
  const Eigen::MatrixXd free = unresisted(tangent, rigid_motions(balance, equilibrium.state()));
  const Eigen::VectorXd root = motion.mass.cwiseSqrt();
  motion.rigid =
      root.cwiseInverse().asDiagonal() * orthonormal(root.asDiagonal() * (per_unknown.cwiseInverse().asDiagonal() * free));
  motion.pressure_load = work * per_unknown.cwiseProduct(pressure_slope(balance, equilibrium));
  return motion;
}

Vibrations natural_vibrations(const SmallMotion& motion, std::size_t largest_count, WithModes with_modes) {
  Vibrations result;
  const Eigen::Index size = motion.mass.size();
  if (size == 0) return result;
  const Eigen::VectorXd root = motion.mass.cwiseSqrt();
  const Eigen::VectorXd per_root = root.cwiseInverse();
  Eigen::MatrixXd dynamic = per_root.asDiagonal() * motion.stiffness * per_root.asDiagonal();
  const Eigen::Index rigid_count = motion.rigid.cols();
  if (rigid_count > 0) {
    // Rigid motions are removed from the matrix and shifted above all other modes.
    const double above = 2.0 * dynamic.norm();
    const Eigen::MatrixXd rigid = root.asDiagonal() * motion.rigid;
    dynamic -= rigid * (rigid.transpose() * dynamic);
    dynamic -= (dynamic * rigid) * rigid.transpose();
    dynamic += above * rigid * rigid.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      dynamic, with_modes == WithModes::yes ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly);
  const Eigen::VectorXd values = solver.eigenvalues().head(size - rigid_count);
  const Eigen::Index unstable = (values.array() <= 0.0).count();
  const Eigen::Index count = std::min(values.size() - unstable, static_cast<Eigen::Index>(largest_count));
  result.unstable_count = static_cast<std::size_t>(unstable);
  for (const double value : values.segment(unstable, count))
    result.frequencies_Hz.push_back(std::sqrt(value) / (2.0 * std::numbers::pi));
  if (with_modes == WithModes::yes) result.modes = per_root.asDiagonal() * solver.eigenvectors().middleCols(unstable, count);
  return result;
}

}  // namespace menger::voxel
