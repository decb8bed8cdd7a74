#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "voxel/statics/equilibrium.h"

namespace menger::voxel {

/// The linear mechanics of a body about an equilibrium: M x'' + K x = b p.
///
/// The unknowns x are displacement (m) and world rotation vector (rad) of every voxel that is not fixed, six per voxel, in the
/// order of the voxels; ForceBalance::first_unknown gives the index of the first.
struct SmallMotion {
  Eigen::MatrixXd stiffness;      ///< K, symmetric part
  Eigen::VectorXd mass;           ///< diagonal of M: masses (kg) and moments of inertia (kg m^2)
  Eigen::VectorXd pressure_load;  ///< b: loads per change of the pressure of all chambers, N/Pa and N m/Pa
  /// Rigid motions of the whole body that nothing resists: those to which the tangent responds with less than 1e-7 of its norm.
  /// They are columns with x^T M x = 1, orthogonal in M.
  Eigen::MatrixXd rigid;
  /// Norm of the antisymmetric part left out of K, divided by the norm of K (Frobenius, scaled unknowns). The beam law of the
  /// engine balances its moments on the length at rest without pressure, so this ratio is of the size of strains and extensions.
  double asymmetry = 0.0;
};

/// Linearises the motion of a body about an equilibrium, without damping. @param supports of the body while it moves: a free body
/// is held at a voxel only to find its equilibrium
SmallMotion small_motion(const Equilibrium& equilibrium, const Supports& supports = {});

/// Natural vibrations, lowest frequency first, orthogonal to the rigid motions.
struct Vibrations {
  std::vector<double> frequencies_Hz;  ///< of modes that oscillate
  Eigen::MatrixXd modes;               ///< as columns, with x^T M x = 1; empty if not asked for
  std::size_t unstable_count = 0;      ///< number of modes that do not oscillate; the equilibrium is stable only if it is 0
};

enum class WithModes { no, yes };

/// Computes the lowest natural vibrations from the dense eigenvalue problem. The cost is O(n^3) for n unknowns: 10 ms for 27
/// voxels, a minute for 400.
Vibrations natural_vibrations(const SmallMotion& motion, std::size_t largest_count, WithModes with_modes = WithModes::no);

}  // namespace menger::voxel
