#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "voxel/statics/static_body.h"

namespace menger::voxel {

/// A beam at given positions, as the lateral coupling (LateralCoupling) uses it.
///
/// Let e = sqrt(EA / l) (d - l), with rest length l and length d. The coupling energy is c times the sum over voxels of S_x S_y +
/// S_y S_z + S_z S_x, where S_a(v) is the sum of share * e over the beams along a at voxel v. The share is 1/2, or 1/sqrt(2) for
/// the half beam to a plate, so that a homogeneous strain gives the same S at a plate as inside. The energy stays positive as
/// with whole beams, because a half beam belongs to only one voxel.
struct CouplingSpring {
  double weight = 0.0;                                 ///< share * sqrt(EA / l), the derivative of share * e with respect to d
  double length = 0.0;                                 ///< d, m
  Eigen::Vector3d direction{Eigen::Vector3d::Zero()};  ///< from the lower to the upper end
  double tension = 0.0;                                ///< added by the coupling, N
};

/// Computes the springs of all beams. @param rest_lengths m, by beam
std::vector<CouplingSpring> coupling_springs(const StaticBody& body, const std::vector<Pose>& poses,
                                             const std::vector<double>& rest_lengths);

/// Pairs of beams along different axes that meet at a voxel, once for every voxel and order.
std::vector<std::array<std::size_t, 2>> coupled_beams(const StaticBody& body);

}  // namespace menger::voxel
