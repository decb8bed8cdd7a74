#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fem/contact/block_loop.h"
#include "fem/contact/self_contact_surface.h"
#include "fem/surfaces/face_tree.h"

namespace menger::fem {

/// Nodes and the faces of their surface that are near them.
struct ContactCandidates {
  std::vector<std::uint32_t> nodes;    ///< those that have any, ascending
  std::vector<std::uint32_t> offsets;  ///< node_count + 1 positions in faces
  std::vector<std::uint32_t> faces;    ///< ascending for each node
  double smallest_m = 0.0;             ///< smallest distance of a node and a face; the reach if there is none below
};

/// Finds nodes and faces of one surface that are near each other, by a tree of boxes over the faces of each surface. The trees
/// are those of the first positions; later ones change their boxes.
class ContactSearch {
 public:
  /// Keeps a reference. @param points of the surfaces' nodes
  ContactSearch(const ContactSurfaces& surfaces, std::span<const Point> points);

  /// All pairs that are less than a reach apart, whichever way they look, without faces of the elements at the node.
  /// Deterministic. @param points finite @param reach_m > 0
  [[nodiscard]] ContactCandidates near_pairs(std::span<const Point> points, double reach_m, const BlockLoop& loop);

 private:
  void fit_boxes(std::span<const Point> points);

  const ContactSurfaces& surfaces_;
  std::vector<FaceTree> trees_;  // one per surface; faces counted from its first one
};

}  // namespace menger::fem
