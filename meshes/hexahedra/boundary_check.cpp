#include "meshes/hexahedra/boundary_check.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

#include "io/text/input_error.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::meshes {
namespace {

/// A side of one or more elements, with the number of elements and of boundary faces there.
struct ElementSide {
  FaceCorners corners{};  ///< in the order of the first element
  int elements = 0;
  int faces = 0;
};

/// The sides of all elements, keyed by their corners in increasing order.
using ElementSides = std::map<FaceCorners, ElementSide>;

ElementSides sides_of_elements(const HexahedralMesh& mesh) {
  ElementSides sides;
  for (const ElementCorners& element : mesh.elements) {
    for (std::size_t side = 0; side < face_corners.size(); ++side) {
      const FaceCorners corners = face_of_element(element, side);
      ElementSide& here = sides[sorted(corners)];
      if (here.elements++ == 0) here.corners = corners;
    }
  }
  return sides;
}

/// Returns whether two orders of four corners have the same direction around the face, wherever they begin.
bool same_way(const FaceCorners& a, FaceCorners b) {
  std::rotate(b.begin(), std::find(b.begin(), b.end(), a[0]), b.end());
  return a == b;
}

}  // namespace

void require_whole_boundary(const HexahedralMesh& mesh, const std::string& source) {
  ElementSides sides = sides_of_elements(mesh);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const FaceCorners& corners = mesh.faces[i].corners;
    const auto refuse = [&](const char* reason) {
      std::string message = source + ": boundary face " + std::to_string(i) + " at ";
      message.append(millimetre_text(mesh.points[corners[0]])).append(" ").append(reason);
      throw io::InputError(message);
    };
    const auto side = sides.find(sorted(corners));
    if (side == sides.end()) refuse("belongs to no element");
    if (side->second.elements > 1) refuse("lies inside the solid");
    if (!same_way(side->second.corners, corners)) refuse("has its corners in the wrong order");
    if (++side->second.faces > 1) refuse("is given twice");
  }
  const auto missing = std::count_if(sides.begin(), sides.end(),
                                     [](const auto& side) { return side.second.elements == 1 && side.second.faces == 0; });
  if (missing > 0)
    throw io::InputError(source + ": " + std::to_string(missing) + " sides of elements on the boundary have no face");
}

}  // namespace menger::meshes
