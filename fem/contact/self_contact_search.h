#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fem/contact/block_loop.h"
#include "fem/contact/self_contact_surface.h"
#include "fem/surfaces/face_tree.h"

namespace menger::fem {

/// Nodes with the faces of their surface that are near them.
struct ContactCandidates {
  std::vector<std::uint32_t> nodes;    ///< nodes that have near faces, ascending
  std::vector<std::uint32_t> offsets;  ///< where the faces of each node begin in `faces`, and the end: one more than nodes
  std::vector<std::uint32_t> faces;    ///< ascending for each node
  double smallest_m = 0.0;             ///< smallest distance between a node and a face; the reach if all are further apart
};

/// A tree of boxes over the faces of a surface, in one list: a node of the tree comes before all that is below it.
struct FaceBoxes {
  struct Node {
    Box box;
    std::uint32_t end = 0;   ///< the node that follows all below this one
    std::uint32_t face = 0;  ///< of a leaf, which has nothing below it
  };
  std::vector<Node> nodes;
};

/// Finds nodes and faces of one surface that are near each other, with a tree of boxes over the faces of each surface. The trees
/// are built for the first positions. Later positions only change their boxes.
class ContactSearch {
 public:
  /// Keeps a reference to the surfaces. @param points positions of the surfaces' nodes
  ContactSearch(const ContactSurfaces& surfaces, std::span<const Point> points);

  /// Returns all pairs that are less than a reach apart, whatever their orientation. It leaves out faces of the elements at the
  /// node. Deterministic. @param points finite @param reach_m > 0
  [[nodiscard]] ContactCandidates near_pairs(std::span<const Point> points, double reach_m, const BlockLoop& loop);

 private:
  void fit_boxes(std::span<const Point> points, const BlockLoop& loop);

  const ContactSurfaces& surfaces_;
  std::vector<FaceBoxes> trees_;  // one per surface
};

}  // namespace menger::fem
