#pragma once

#include <array>
#include <vector>

#include "voxel/laws/lattice.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/wall_classes.h"

namespace menger::voxel {

/// Two components of a rotation vector, along the two axes after a beam's own (in the order x, y, z, x, ...).
template <class Value>
using AcrossBeam = std::array<Value, 2>;

/// How a limb rides on the dome of a plate that it leaves, by the wall classes of the dome (bulge classes).
///
/// An open side of a voxel lies in a plate with each of its four corners whose three other voxels belong to the same chamber and
/// have a free wall on that side. Such a corner stands out by
///
///   h = neck_ratio times the mean of L bulge_peak_ratio[c] bulge[c] over the four voxels,
///
/// the crown that the four would share (WallFoot), raised because the opening does not hold it. Other corners do not stand out.
/// The limb stands on the plane that fits the four corners best. It is lifted by the mean of h, and tilted by the slopes of that
/// plane along the axes u and v after that of the side,
///
///   s = (sum of h on the upper side - sum of h on the lower side) / (2 L).
///
/// So the half beam through the side is longer by the lift, and the voxel at the upper end of the beam is turned against that at
/// the lower end by (s_v, -s_u) about u and v, whichever end the plate is at. In the middle of a plate a limb stands upright.
struct WallOpening {
  ByLawClass<double> lift{};              ///< times L bulge_peak_ratio[c] bulge[c] and neck_ratio: the lift, m
  AcrossBeam<ByLawClass<double>> turn{};  ///< times bulge_peak_ratio[c] bulge[c] and neck_ratio: the turn, rad
  bool lifts = false;                     ///< whether any corner lies in a plate
  bool tilts = false;                     ///< whether any turn is not zero
};

/// Returns the openings of all voxels, per voxel and side (-x, +x, -y, ...). A side with a wall, one inside a wide body, where
/// the cross section continues, and one in a tube lift nothing.
///
/// Where a cell has several voxels along an edge, openings do not tilt: the beams of a limb lie side by side there, and their
/// lengths tilt it.
std::vector<std::array<WallOpening, 6>> wall_openings(const Lattice& lattice, const HollowVoxels& voxels, int voxels_per_cell);

/// Whether any limb of a body is tilted.
bool has_tilted_limbs(const std::vector<std::array<WallOpening, 6>>& openings);

}  // namespace menger::voxel
