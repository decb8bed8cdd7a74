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
/// are built for the first positions. Later positions only change their boxes. Nodes go through the trees in groups of those that
/// lie together. The faces that a group finds far around it serve for further searches, until the body has changed its shape so
/// much that they may lack one.
class ContactSearch {
 public:
  /// Keeps a reference to the surfaces. @param points positions of the surfaces' nodes
  ContactSearch(const ContactSurfaces& surfaces, std::span<const Point> points);

  /// Returns all pairs that are less than a reach apart, whatever their orientation. It leaves out faces of the elements at the
  /// node. Deterministic. @param points finite @param reach_m > 0
  [[nodiscard]] ContactCandidates near_pairs(std::span<const Point> points, double reach_m, const BlockLoop& loop);

  /// Returns a bound, m: a node and a face of its surface that near_pairs, which must have been called, did not return are now
  /// further apart than the reach less the bound. Parts of a body that lie near each other mostly move together. So the bound is
  /// much less than the displacements: the largest difference of two displacements among the nodes of a group and the faces
  /// within twice the reach. Others were at least twice the reach apart; from them it is the largest difference of two
  /// displacements on the surface, less the reach. Infinite where that is twice the reach or more. @param points finite
  [[nodiscard]] double largest_approach_m(std::span<const Point> points, const BlockLoop& loop);

  /// Returns the smallest distance of pairs that near_pairs has found, at other positions; at most the reach, m.
  [[nodiscard]] double smallest_distance_m(const ContactCandidates& candidates, std::span<const Point> points) const;

 private:
  /// Nodes of one surface that lie together, in grouped_nodes_.
  struct Group {
    std::size_t surface;
    std::size_t begin;
    std::size_t end;
  };
  void add_groups(std::size_t surface);
  void fit_boxes(std::span<const Point> points, const BlockLoop& loop);
  void set_faces_around(std::span<const Point> points, double reach_m, const BlockLoop& loop);
  void set_face_ways(std::span<const Point> points, std::span<const Point> since, const BlockLoop& loop);
  [[nodiscard]] double largest_way_m() const;
  [[nodiscard]] Box box_of(const Group& group, std::span<const Point> points) const;
  [[nodiscard]] std::span<const std::uint32_t> nodes_of(const Group& group) const {
    return std::span(grouped_nodes_).subspan(group.begin, group.end - group.begin);
  }

  const ContactSurfaces& surfaces_;
  std::vector<FaceBoxes> trees_;  // one per surface
  std::vector<Box> face_boxes_;
  std::vector<std::uint32_t> grouped_nodes_;
  std::vector<Group> groups_;
  // Of the last search:
  double reach_m_ = 0.0;
  std::vector<Point> searched_points_;
  std::vector<std::vector<std::uint32_t>> faces_about_;  // within distance_about of each group
  // Of an earlier search, where the trees were visited:
  std::vector<Point> listed_points_;
  std::vector<std::vector<std::uint32_t>> faces_around_;  // within distance_around of each group
  std::vector<Box> face_ways_;                            // of the displacements of each face's corners
};

}  // namespace menger::fem
