#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
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

/// The default stiffness of self-contact: four times that of the ground. On the hollow cube of 20 mm with walls of one element of
/// 2 mm it makes steps 9 % shorter while walls touch. A vacuum of 20 kPa that closes the chamber leads to depths up to 1/8 of an
/// element.
/// @param modulus_Pa the largest bulk modulus of a body; less for thin-wall elements, see contact_modulus_Pa
/// @param edge_m the shortest edge of its elements
constexpr double self_contact_stiffness_Pa_per_m(double modulus_Pa, double edge_m) {
  return ground_stiffness_Pa_per_m(modulus_Pa, edge_m, 0.2);
}

/// Limits the springs of a contact by the masses that they join. Nodes on the edges and corners of a body carry the springs of
/// two and three faces, but little mass; such springs would be what shortens the steps of a body.
struct TouchLimit {
  std::span<const double> masses_kg;  ///< per node of the mesh; empty: no limit
  /// Largest square of the angular frequency at which a spring alone makes its node and its face swing against each other, > 0.
  double largest_per_s2 = 0.0;
};

/// Returns the limit at which the springs of two walls just do not change where these are as thin as the thinnest wall: 2 k /
/// (rho h), since a wall has the mass rho h / 2 under each unit of area, and the springs of a pair of nodes have k / 2.
/// @param stiffness_Pa_per_m k @param density_kg_per_m3 rho, of the lightest material
/// @param thickness_m h, the shortest edge of the elements
constexpr double touch_limit_per_s2(double stiffness_Pa_per_m, double density_kg_per_m3, double thickness_m) {
  return 2.0 * stiffness_Pa_per_m / (density_kg_per_m3 * thickness_m);
}

/// The stiffness and friction with which parts of a body's surface press on each other.
struct SelfContactLaw {
  /// Pressure divided by depth, > 0. Nothing: self_contact_stiffness_Pa_per_m of the body's modulus and shortest edge, with a
  /// TouchLimit.
  std::optional<double> stiffness_Pa_per_m{};
  /// Nothing: the coefficients of the ground, or no friction where there is no ground.
  std::optional<SurfaceFriction> friction{};
};

/// A node that lies behind a face of its own surface.
struct SelfTouch {
  std::uint32_t node;                       ///< of the mesh
  std::uint32_t surface;                    ///< 0: the outside; c + 1: chamber c
  std::array<std::uint32_t, 4> face_nodes;  ///< of the mesh
  std::array<double, 4> weights;            ///< of the face's nodes at the point nearest to the node
  Point behind_m;                           ///< from the nearest point to the node; its length is the depth
  double spring_N_per_m;
  /// Compression of the spring, at most the depth. Its force pushes the node out, against behind_m.
  double pressed_m = 0.0;
  Point friction_N{};                      ///< force on the node, along the face
  std::array<Point, 4> face_friction_N{};  ///< reaction on the face's nodes, with its moment
};

/// Contact of a body with itself: between parts of its outside, and between the walls of one chamber.
///
/// It is a penalty method. A node of area A at a depth d behind a face of its own surface is pushed out by the force k A d / 2,
/// towards the nearest point there. That point takes the opposite force. Both sides do this, so that two flat surfaces that
/// overlap by d press on each other with k d. Momentum and angular momentum are conserved. Where depths change by motion alone,
/// the energy k A d^2 / 4 is a function of the positions and the force is its negative gradient. A node that slips over an edge
/// of the body, or in from beside it, is deep at once. Its memory limits how far its spring may then be compressed (see
/// ContactMemory), so that contact takes energy and never gives any.
///
/// With a TouchLimit, springs are k A / 2 or what the masses of the node and of the point of the face bear, whichever is less:
/// masses m and m_c with weights w_c swing with k (1/m + sum w_c^2 / m_c). Such a spring changes as its node slides along faces;
/// its force is the negative gradient with the spring held. Its memory sees to it that the change gives no energy either.
///
/// Friction along the faces acts through springs that break away (see friction_force_N).
///
/// depth_of decides when a node is behind a face. It sees depths up to half of the mesh's shortest edge and leaves out faces of
/// elements at the node. At rest, neighbours along a surface and at concave edges are one whole edge away. A fold is held once it
/// has closed so far that the first nodes beside its edge meet the other side.
///
/// Limits: edges that cross between nodes are not felt until a node is behind a face. A solid wall with both sides on one surface
/// must stay thicker than half of the shortest edge, except for the wall of an element at the node itself. A node that has
/// slipped in from beside the body is not pushed back to where it came in.
///
/// While nothing can touch, the cost is one comparison: a node and a face at a distance d cannot meet before they have approached
/// each other by d. Paths bound that: twice the largest one. Where the paths are long enough, the distances of pairs that were
/// near are measured anew, and the displacements of the others are looked up, since parts that lie near each other move together
/// and bodies swing back; only where neighbours have approached each other too far, the search runs again. Where some pairs are
/// near, each node that is behind no face that faces it is passed over in the same way until it may have come to the nearest.
class SelfContact {
 public:
  /// @param with_outside false: only the walls of chambers are searched
  SelfContact(const meshes::HexahedralMesh& mesh, double stiffness_Pa_per_m, bool with_outside = true,
              const SurfaceFriction& friction = {}, const TouchLimit& limit = {});

  SelfContact(const SelfContact&) = delete;
  SelfContact& operator=(const SelfContact&) = delete;

  /// Must be called after nodes have moved. @param travel_m largest displacement of a node, m, apart from a motion that all nodes
  /// have in common
  void moved(double travel_m);
  /// Must be called after positions have jumped: the results of the last search are no longer valid.
  void forget();
  /// Whether find_touches has anything to do. If not, nothing touches.
  [[nodiscard]] bool is_awake() const { return is_near_ || must_look(); }

  /// Returns how far nodes may move, in the sum of their steps, before any can touch something, m. 0 where some do.
  [[nodiscard]] double free_travel_m() const;
  /// In place of moved(), after several steps in which nothing can have touched: their travels added up, less than
  /// free_travel_m() before the last of them.
  void passed(double travel_m);

  /// Whether find_touches reads the positions of all nodes; otherwise only those of followed_nodes().
  [[nodiscard]] bool reads_all_nodes() const { return must_look(); }
  /// Nodes of the mesh, some of them twice.
  [[nodiscard]] const std::vector<std::uint32_t>& followed_nodes() const { return followed_mesh_nodes_; }

  /// Finds the nodes that are behind faces. @param positions_m 3 per node of the mesh, finite; see reads_all_nodes()
  /// @param past the step that led to these positions; none: springs are compressed by their full depth, and nothing has slipped
  void find_touches(std::span<const double> positions_m, const BlockLoop& loop, const ContactPast* past = nullptr);
  [[nodiscard]] const std::vector<SelfTouch>& touches() const { return touches_; }
  /// The memories after find_touches, ascending by node. They are the past of the next step.
  [[nodiscard]] const std::vector<ContactMemory>& memories() const { return memories_; }
  /// Whether these can be memories of this body: ascending, of nodes and faces that it has, with finite numbers.
  [[nodiscard]] bool can_have(std::span<const ContactMemory> memories) const;
  /// Forces of the springs on the mesh's nodes, 3 per node; empty while nothing touches.
  [[nodiscard]] std::span<const double> forces_N() const;
  /// Forces of friction, in the same layout; also empty if there is no friction.
  [[nodiscard]] std::span<const double> friction_N() const;
  [[nodiscard]] double energy_J() const;

  /// Resets the largest depth and the largest travel to zero.
  void watch();
  [[nodiscard]] double largest_depth_m() const { return largest_depth_; }
  [[nodiscard]] double largest_travel_m() const { return largest_travel_; }  ///< in one call of moved() while pairs were near
  /// With depths up to the first and travel in one step up to the second, no pair can have been missed.
  [[nodiscard]] double allowed_depth_m() const { return 0.8 * largest_seen_depth_m(); }
  [[nodiscard]] double allowed_travel_m() const { return 0.5 * (largest_seen_depth_m() - allowed_depth_m()); }

  [[nodiscard]] std::size_t search_count() const { return searches_; }

 private:
  [[nodiscard]] double reach_m() const { return 0.75 * surfaces_.shortest_edge_m(); }
  [[nodiscard]] double largest_seen_depth_m() const { return 0.5 * surfaces_.shortest_edge_m(); }
  [[nodiscard]] bool must_look() const { return !(approach_ < reach_m() && (is_near_ || path_ < gap_)); }
  struct Found {
    SelfTouch touch;
    ContactMemory memory;
  };
  void look(std::vector<Point> points, const BlockLoop& loop);
  void follow_candidates();
  [[nodiscard]] double clearance_m(std::size_t candidate) const;
  [[nodiscard]] std::optional<Found> touch_of(std::size_t candidate, const ContactPast* past) const;
  [[nodiscard]] double spring_N_per_m(std::size_t node, std::size_t face, const std::array<double, 4>& weights) const;
  [[nodiscard]] ContactMemory memory_behind(std::size_t node, std::size_t face, double depth_m, double spring_N_per_m,
                                            const ContactPast* past) const;
  void add_friction(Found& found, const ContactPast& past) const;
  void set_memories(const ContactPast* past);
  void set_forces();

  ContactSurfaces surfaces_;
  ContactSearch search_;
  double stiffness_;
  SurfaceFriction friction_;
  std::vector<double> lightness_per_kg_;  // inverse masses of the surfaces' nodes; empty: no limit
  double largest_per_s2_;
  ContactCandidates candidates_;
  std::vector<std::uint32_t> followed_nodes_;  // nodes of the followed faces
  std::vector<std::uint32_t> followed_mesh_nodes_;
  std::vector<std::uint32_t> followed_faces_;
  std::vector<Point> points_;   // of followed nodes
  std::vector<Point> normals_;  // of followed faces
  bool is_near_ = false;
  // Bounds of how much nearer a node and a face have come:
  double approach_ = std::numeric_limits<double>::infinity();  // since the last search; infinite: there was none
  double path_ = 0.0;                                          // since distances were measured
  double gap_ = 0.0;                                           // the smallest distance of candidates then
  double followed_path_ = 0.0;                                 // since the candidates are followed
  std::size_t searches_ = 0;
  double largest_depth_ = 0.0;
  double largest_travel_ = 0.0;
  std::vector<std::optional<Found>> found_;  // per candidate node
  std::vector<double> clear_until_;          // per candidate node that touches nothing: the followed path before which it cannot
  std::vector<SelfTouch> touches_;
  std::vector<ContactMemory> memories_;
  std::vector<double> forces_;
  std::vector<double> friction_forces_;
};

}  // namespace menger::fem
