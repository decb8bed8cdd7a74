#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fem/contact/block_loop.h"
#include "fem/contact/rigid_ground.h"
#include "fem/contact/self_contact_friction.h"
#include "fem/contact/self_contact_memory.h"
#include "fem/contact/self_contact_search.h"
#include "fem/contact/self_contact_surface.h"

namespace menger::fem {

/// The default rule for the stiffness of self-contact, four times that of the ground. On the hollow cube of 20 mm with walls of
/// one element of 2 mm it makes steps 9 % shorter while walls touch, and a vacuum of 20 kPa that shuts the chamber makes depths
/// up to an eighth of an element.
/// @param bulk_modulus_Pa largest of the body @param edge_m shortest edge of its elements
constexpr double self_contact_stiffness_Pa_per_m(double bulk_modulus_Pa, double edge_m) {
  return ground_stiffness_Pa_per_m(bulk_modulus_Pa, edge_m, 0.2);
}

/// How parts of a body's surface push each other.
struct SelfContactLaw {
  /// Pressure by depth, > 0; nothing: self_contact_stiffness_Pa_per_m of the body's largest bulk modulus and shortest edge.
  std::optional<double> stiffness_Pa_per_m{};
  /// Nothing: with the coefficients of the ground, and none where there is no ground.
  std::optional<SurfaceFriction> friction{};
};

/// A node behind a face.
struct SelfTouch {
  std::uint32_t node;                       ///< of the mesh
  std::uint32_t surface;                    ///< 0: the outside; c + 1: chamber c
  std::array<std::uint32_t, 4> face_nodes;  ///< of the mesh
  std::array<double, 4> weights;            ///< of the face's nodes in the point that is nearest to the node
  Point behind_m;                           ///< from that point to the node; its length is the depth
  double spring_N_per_m;
  double pressed_m = 0.0;                  ///< of the spring, at most the depth: its force pulls the node back against behind_m
  Point friction_N{};                      ///< on the node, along the face
  std::array<Point, 4> face_friction_N{};  ///< on the face's nodes: their answer, with its moment
};

/// Contact of a body with itself: of parts of its outside, and of walls of one chamber, with each other.
///
/// Penalty: a node of area A that is a depth d behind a face of its own surface is pushed out by k A d / 2 towards the nearest
/// point there, which takes the opposite force. Both sides do this, so that two flat surfaces a depth d in each other press with
/// k d. Momentum and angular momentum are kept. Where depths change by motion alone the energy k A d^2 / 4 is a function of
/// positions and its gradient the force. A node that slips over an edge of the body or in from beside it is deep at once: what
/// its spring may then hold says its memory (see ContactMemory), so that contact takes energy and never gives any.
///
/// Friction along the faces is that of springs which break away (see friction_force_N).
///
/// When a node is behind a face says depth_of; up to half of the mesh's shortest edge, without faces of elements at the node. At
/// rest, neighbours along a surface and at concave edges are a whole edge away, and a fold is held when it has shut to where the
/// first nodes beside its edge meet the other side.
///
/// Limits: edges that cross between nodes are not felt until a node is behind a face; solid walls both sides of which belong to
/// one surface must stay thicker than half of the shortest edge, but for an element's own; a node that has slipped in from beside
/// the body is not pushed back to where it could have come in.
///
/// What it costs while nothing can touch is one comparison: two nodes that were d apart cannot meet before the largest ways since
/// then add up to d, and only then is looked again.
class SelfContact {
 public:
  /// @param with_outside otherwise chambers' walls alone are looked at
  SelfContact(const meshes::HexahedralMesh& mesh, double stiffness_Pa_per_m, bool with_outside = true,
              const SurfaceFriction& friction = {});

  SelfContact(const SelfContact&) = delete;
  SelfContact& operator=(const SelfContact&) = delete;

  /// Tells that nodes have moved by up to so much, m, apart from a motion that all of them have in common.
  void moved(double travel_m);
  /// Positions jump: what was found is void.
  void forget();
  /// Whether find_touches has anything to do. While it has not, nothing touches.
  [[nodiscard]] bool is_awake() const { return is_near_ || must_search(); }

  /// Looks where nodes are behind faces. @param positions_m 3 per node of the mesh, finite @param past how they came there; none:
  /// springs are pressed by all of their depth, and nothing has slipped
  void find_touches(std::span<const double> positions_m, const BlockLoop& loop, const ContactPast* past = nullptr);
  [[nodiscard]] const std::vector<SelfTouch>& touches() const { return touches_; }
  /// After find_touches, ascending by node: the past of the next step.
  [[nodiscard]] const std::vector<ContactMemory>& memories() const { return memories_; }
  /// Of the springs on the mesh's nodes, 3 per node; empty while nothing touches.
  [[nodiscard]] std::span<const double> forces_N() const;
  /// Of friction, as above; empty without friction, too.
  [[nodiscard]] std::span<const double> friction_N() const;
  [[nodiscard]] double energy_J() const;

  /// A bound of the largest eigenvalue of M^-1 K of the springs, 1/s^2: blocks' norms added up row by row. Without the turn of
  /// faces, whose part is less by depth over edge. @param masses_kg per node of the mesh
  [[nodiscard]] double stiffness_per_s2(std::span<const double> masses_kg) const;

  /// Begins to note the next two.
  void watch();
  [[nodiscard]] double largest_depth_m() const { return largest_depth_; }
  [[nodiscard]] double largest_travel_m() const { return largest_travel_; }  ///< in one move while pairs were near
  /// Depths up to which, and travel in one step with which, no pair can have been missed.
  [[nodiscard]] double allowed_depth_m() const { return 0.8 * largest_seen_depth_m(); }
  [[nodiscard]] double allowed_travel_m() const { return 0.5 * (largest_seen_depth_m() - allowed_depth_m()); }

  [[nodiscard]] std::size_t search_count() const { return searches_; }

 private:
  [[nodiscard]] double reach_m() const { return 0.75 * surfaces_.shortest_edge_m(); }
  [[nodiscard]] double largest_seen_depth_m() const { return 0.5 * surfaces_.shortest_edge_m(); }
  [[nodiscard]] bool must_search() const { return !(2.0 * travel_ < allowance_); }
  struct Found {
    SelfTouch touch;
    ContactMemory memory;
  };
  void search(std::span<const double> positions_m, const BlockLoop& loop);
  void follow_candidates();
  [[nodiscard]] std::optional<Found> touch_of(std::size_t candidate, const ContactPast* past) const;
  [[nodiscard]] ContactMemory memory_behind(std::size_t node, std::size_t face, double depth_m, const ContactPast* past) const;
  void add_friction(Found& found, const ContactPast& past) const;
  void set_memories(const ContactPast* past);
  void set_forces();

  ContactSurfaces surfaces_;
  ContactSearch search_;
  double stiffness_;
  SurfaceFriction friction_;
  ContactCandidates candidates_;
  std::vector<std::uint32_t> followed_nodes_;  // what candidates need to know
  std::vector<std::uint32_t> followed_faces_;
  std::vector<Point> points_;   // of followed nodes
  std::vector<Point> normals_;  // of followed faces
  bool is_near_ = false;
  double allowance_ = 0.0;  // the sum of two nodes' travel after which candidates may lack a pair
  double travel_ = 0.0;     // since the search
  std::size_t searches_ = 0;
  double largest_depth_ = 0.0;
  double largest_travel_ = 0.0;
  std::vector<std::optional<Found>> found_;  // per candidate node
  std::vector<SelfTouch> touches_;
  std::vector<ContactMemory> memories_;
  std::vector<double> forces_;
  std::vector<double> friction_forces_;
};

}  // namespace menger::fem
