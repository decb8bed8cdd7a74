#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "voxel/statics/equilibrium.h"

namespace menger::voxel {

/// The linear mechanics of a body about an equilibrium: M x'' + K x = b p.
///
/// Unknowns x are displacement (m) and world rotation vector (rad) of every voxel that is not fixed, six by six in the order of
/// the voxels; ForceBalance::first_unknown says where one begins.
struct SmallMotion {
  Eigen::MatrixXd stiffness;      ///< K, symmetric part
  Eigen::VectorXd mass;           ///< diagonal of M: mass (kg) and moment of inertia (kg m^2)
  Eigen::VectorXd pressure_load;  ///< b: loads per change of the pressure of all chambers, N/Pa and N m/Pa
  /// Motions of the whole body that nothing resists, as columns with x^T M x = 1, orthogonal in M: those rigid motions that the
  /// tangent answers with less than 1e-7 of its norm.
  Eigen::MatrixXd rigid;
  /// Norm of the antisymmetric part left out of K by the norm of K (Frobenius, scaled unknowns): the beam law of the engine
  /// balances its moments on the length at rest without pressure, so that it is of the size of strains and extensions.
  double asymmetry = 0.0;
};

/// Small motion about an equilibrium, without damping. @param supports what holds the body while it moves: a free body is held
/// by a voxel in its equilibrium only
SmallMotion small_motion(const Equilibrium& equilibrium, const Supports& supports = {});

/// Natural vibrations, lowest first, orthogonal to the rigid motions.
struct Vibrations {
  std::vector<double> frequencies_Hz;  ///< of motions that return
  Eigen::MatrixXd modes;               ///< as columns, with x^T M x = 1; empty where they were not asked for
  std::size_t unstable_count = 0;      ///< motions that do not return: the equilibrium is none that lasts
};

enum class WithModes { no, yes };

/// The lowest natural vibrations by a dense solution of the eigenvalue problem: O(n^3) for n unknowns, 10 ms for 27 voxels, a
/// minute for 400.
Vibrations natural_vibrations(const SmallMotion& motion, std::size_t largest_count, WithModes with_modes = WithModes::no);

}  // namespace menger::voxel
