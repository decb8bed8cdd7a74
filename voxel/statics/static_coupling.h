#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "voxel/statics/static_body.h"

namespace menger::voxel {

/// A beam as the lateral coupling of LateralCoupling sees it at given positions.
///
/// With e = sqrt(EA / l) (d - l) at rest length l and length d, the coupling energy is c sum over voxels of S_x S_y + S_y S_z +
/// S_z S_x, S_a(v) the sum of share * e over the beams along a at v. The share is 1/2; for the half beam to a plate 1/sqrt(2), so
/// that a homogeneous strain gives the same S at a plate as inside. The energy stays positive as with whole beams, since a half
/// beam belongs to one voxel only.
struct CouplingSpring {
  double weight = 0.0;                                 ///< share * sqrt(EA / l), the derivative of share * e with respect to d
  double length = 0.0;                                 ///< d, m
  Eigen::Vector3d direction{Eigen::Vector3d::Zero()};  ///< from the lower to the upper end
  double tension = 0.0;                                ///< that the coupling adds, N
};

/// The springs of all beams. @param rest_lengths m, by beam
std::vector<CouplingSpring> coupling_springs(const StaticBody& body, const std::vector<Pose>& poses,
                                             const std::vector<double>& rest_lengths);

/// Pairs of beams along different axes that meet at a voxel, once for every voxel and order.
std::vector<std::array<std::size_t, 2>> coupled_beams(const StaticBody& body);

}  // namespace menger::voxel
