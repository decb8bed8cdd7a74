#include "voxel/scene/body_pieces.h"

#include "meshes/design/connectivity.h"

namespace menger::voxel {

BodyPieces body_pieces(const meshes::Polycube& body, const Physics& physics) {
  BodyPieces pieces{.count = meshes::count_components(body), .is_refused = false, .text = {}};
  if (pieces.count <= 1) return pieces;
  pieces.text = "the body is in " + std::to_string(pieces.count) + " pieces";
  pieces.is_refused = physics.surrogate && physics.surrogate->level == 1;
  if (pieces.is_refused) {
    pieces.text += ", which cannot be cast as one body";
  } else {
    pieces.text += " that no beam joins";
    if (physics.surrogate) pieces.text += ": they are separate bodies, whose chambers are driven in the same way";
  }
  return pieces;
}

}  // namespace menger::voxel
