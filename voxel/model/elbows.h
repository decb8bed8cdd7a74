#pragma once

#include <array>
#include <vector>

#include "voxel/laws/lattice.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/wall_openings.h"

namespace menger::voxel {

/// How the beams of a body turn where its tubes bend: for each axis, a turn for each beam, in the order of Lattice::beams.
///
/// Where a tube bends or branches, two walls meet in an edge that points inwards. The pressure pulls at this edge along both
/// walls, and nothing holds it from behind as it holds the outer edges. So it gives way, and the arms of the elbow open. A beam
/// from a voxel to its neighbour bends at such an edge for each side across the beam on which the voxel has another neighbour and
/// the neighbour has none. The neighbour is turned away from that side by
///
///   elbow_ratio times e,
///
/// with e the strain that the pressure gives the beam, the mean extension of its two halves, whatever the pressure of other
/// chambers. Edges between modules count as those within them. At a crossing the turns of opposite sides cancel, and in a step
/// those of its two edges, so that the offset by which a step opens is left out.
///
/// A turn is given as in WallOpening, for an elbow_ratio times e of 1: the voxel at the upper end of the beam against that at
/// the lower end, about the two axes after the beam's own, rad. Where a limb leaves a plate of its chamber, the plate decides how
/// it leans (WallOpening), so edges on a side that lies in a plate do not count; where it stands on a plate of another module it
/// does not lean at all. Nor do edges of voxels finer than cells count: there the beams that lie side by side bend an arm by
/// their lengths.
std::array<std::vector<AcrossBeam<double>>, 3> elbow_turns(const Lattice& lattice, const HollowVoxels& voxels,
                                                           int voxels_per_cell);

/// Whether any beam of a body turns at an elbow.
bool has_elbows(const std::array<std::vector<AcrossBeam<double>>, 3>& turns);

}  // namespace menger::voxel
