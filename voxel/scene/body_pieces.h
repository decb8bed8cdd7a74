#pragma once

#include <cstddef>
#include <string>

#include "meshes/design/polycube.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// The pieces of a body, counted by the faces that cells share, and whether the body is refused for that reason.
///
/// Solid voxels may be in any number of pieces. A calibrated body of level 1 is one casting, with one chamber or one per phase;
/// in pieces it cannot be cast as one body and is refused. From level 2 on, modules are separate castings, bonded where they
/// touch. If modules do not all touch, or are in pieces themselves, the aggregate is several bodies that a common supply drives
/// alike. It is simulated, with a note. This may happen to an aggregate even if its basal body is in one piece at level 1.
struct BodyPieces {
  std::size_t count = 0;
  bool is_refused = false;
  std::string text;  ///< why the body is refused, or a note on more than one piece; otherwise empty
};

/// Counts the pieces of a body. @param body whole aggregate, of the level given by physics.surrogate
BodyPieces body_pieces(const meshes::Polycube& body, const Physics& physics);

}  // namespace menger::voxel
