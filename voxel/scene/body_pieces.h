#pragma once

#include <cstddef>
#include <string>

#include "meshes/design/polycube.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// The pieces of a body, counted by the faces that cells share, and what follows from them.
///
/// Solid voxels may be in any number of pieces. A calibrated body of level 1 is one casting, with one chamber or one per phase:
/// in pieces it cannot be cast as one body and is refused. From level 2 on modules are castings of their own, bonded where they
/// touch: a body whose modules do not all touch, or are in pieces themselves, is several bodies that a common supply drives
/// alike, and is simulated, with a note. A fractal whose basal body is sound at level 1 may well be such a body above.
struct BodyPieces {
  std::size_t count = 0;
  bool is_refused = false;
  std::string text;  ///< why it is refused, or what a user should know about more than one; otherwise empty
};

/// @param body whole aggregate, of the level that physics.surrogate states
BodyPieces body_pieces(const meshes::Polycube& body, const Physics& physics);

}  // namespace menger::voxel
