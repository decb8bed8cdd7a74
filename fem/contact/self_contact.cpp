#include "fem/contact/self_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/contact/self_contact_depth.h"

namespace menger::fem {
namespace {

constexpr std::size_t candidates_per_block = 32;
constexpr std::size_t faces_per_block = 512;
constexpr double largest_looked_up = 0.8;  // relative to the reach: nearer to it displacements would be looked up at each step
constexpr double no_path = 1e-12;          // displacement relative to the shortest edge; stands for the rounding of depths
constexpr double nothing_paid = 1e-18;     // relative to the square of the shortest edge

/// Whether a point is surely in front of every point of a face: each of them is a mean of the corners.
bool is_in_front(const FaceCorners& corners, const Point& normal, const Point& point) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Point& corner) { return dot(difference(point, corner), normal) > 0.0; });
}

std::vector<double> positions_of(const meshes::HexahedralMesh& mesh) {
  std::vector<double> positions;
  positions.reserve(3 * mesh.points.size());
  for (const meshes::Point& point : mesh.points) positions.insert(positions.end(), point.begin(), point.end());
  return positions;
}

}  // namespace

SelfContact::SelfContact(const meshes::HexahedralMesh& mesh, double stiffness_Pa_per_m, bool with_outside,
                         const SurfaceFriction& friction, const TouchLimit& limit)
    : surfaces_(mesh, with_outside),
      search_(surfaces_, surfaces_.points(positions_of(mesh))),
      stiffness_(stiffness_Pa_per_m),
      friction_(friction),
      largest_per_s2_(limit.largest_per_s2),
      normals_(surfaces_.face_count()),
      forces_(3 * mesh.points.size(), 0.0) {
  if (friction.static_coefficient > 0.0) friction_forces_.resize(forces_.size(), 0.0);
  if (limit.masses_kg.empty()) return;
  for (std::size_t node = 0; node < surfaces_.node_count(); ++node)
    lightness_per_kg_.push_back(1.0 / limit.masses_kg[surfaces_.mesh_node(node)]);
}

void SelfContact::moved(double travel_m) {
  passed(travel_m);
  if (is_near_) largest_travel_ = std::max(largest_travel_, travel_m);
}

double SelfContact::free_travel_m() const {
  if (must_look() || !touches_.empty()) return 0.0;
  double free = reach_m() - approach_;
  if (!is_near_) return 0.5 * std::min(free, gap_ - path_);
  for (const double until : clear_until_) free = std::min(free, until - followed_path_);
  return 0.5 * std::max(free, 0.0);
}

void SelfContact::passed(double travel_m) {
  approach_ += 2.0 * travel_m;
  path_ += 2.0 * travel_m;
  followed_path_ += 2.0 * travel_m;
}

void SelfContact::forget() { approach_ = std::numeric_limits<double>::infinity(); }

void SelfContact::watch() {
  largest_depth_ = 0.0;
  largest_travel_ = 0.0;
}

void SelfContact::find_touches(std::span<const double> positions_m, const BlockLoop& loop, const ContactPast* past) {
  if (must_look()) look(surfaces_.points(positions_m), loop);
  if (!is_near_ && touches_.empty()) {
    set_memories(past);
    return;
  }
  for (const std::uint32_t node : followed_nodes_) points_[node] = surfaces_.point(node, positions_m);
  loop.run(followed_faces_.size(), faces_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Point area = area_vector(surfaces_.corners(followed_faces_[f], points_));
      const double size = norm(area);
      normals_[followed_faces_[f]] = size > 0.0 ? scaled(1.0 / size, area) : Point{};
    }
  });
  loop.run(found_.size(), candidates_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (followed_path_ < clear_until_[n]) continue;
      found_[n] = touch_of(n, past);
      if (!found_[n]) clear_until_[n] = followed_path_ + clearance_m(n);
    }
  });
  set_memories(past);
  set_forces();
}

/// Finds out what is near, by a search only where pairs that it did not find before may have come near.
void SelfContact::look(std::vector<Point> points, const BlockLoop& loop) {
  points_ = std::move(points);
  if (std::isfinite(approach_)) approach_ = std::min(approach_, search_.largest_approach_m(points_, loop));
  bool is_followed = is_near_;
  if (approach_ < largest_looked_up * reach_m()) {
    gap_ = search_.smallest_distance_m(candidates_, points_);
  } else {
    candidates_ = search_.near_pairs(points_, reach_m(), loop);
    gap_ = candidates_.smallest_m;
    approach_ = 0.0;
    is_followed = false;
    ++searches_;
  }
  path_ = 0.0;
  // While all pairs are far apart, another look when the nearest pair may have met is cheaper than to follow all pairs at each
  // step.
  is_near_ = gap_ < 0.5 * reach_m();
  if (is_near_ && is_followed) return;
  found_.assign(is_near_ ? candidates_.nodes.size() : 0, std::nullopt);
  followed_path_ = 0.0;
  clear_until_.assign(found_.size(), 0.0);
  follow_candidates();
}

void SelfContact::follow_candidates() {
  const auto make_unique = [](std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  };
  followed_faces_.clear();
  followed_nodes_.clear();
  followed_mesh_nodes_.clear();
  if (!is_near_) return;
  // If a nearest point lies on the rim of a face, the neighbours of the face count, too.
  for (const std::uint32_t face : candidates_.faces)
    for (const std::uint32_t node : surfaces_.face(face))
      followed_faces_.insert(followed_faces_.end(), surfaces_.faces_around(node).begin(), surfaces_.faces_around(node).end());
  for (const std::uint32_t node : candidates_.nodes)
    followed_faces_.insert(followed_faces_.end(), surfaces_.faces_around(node).begin(), surfaces_.faces_around(node).end());
  make_unique(followed_faces_);
  for (const std::uint32_t face : followed_faces_)
    followed_nodes_.insert(followed_nodes_.end(), surfaces_.face(face).begin(), surfaces_.face(face).end());
  make_unique(followed_nodes_);
  for (const std::uint32_t node : followed_nodes_) followed_mesh_nodes_.push_back(surfaces_.mesh_node(node));
}

/// Returns the path on which a candidate that touches nothing surely meets no face: its smallest distance from its faces, at most
/// the reach, m. It is 0 where the node is behind a face that faces it, or would after a turn of some degrees. There it touches
/// nothing although it is behind, as beside the rim of a face (see depth_of), and a small slip changes that.
double SelfContact::clearance_m(std::size_t candidate) const {
  constexpr double largest_cosine = -0.05;
  const std::uint32_t node = candidates_.nodes[candidate];
  const Point& point = points_[node];
  const auto around = surfaces_.faces_around(node);
  double smallest_square = reach_m() * reach_m();
  for (std::size_t f = candidates_.offsets[candidate]; f < candidates_.offsets[candidate + 1]; ++f) {
    const std::uint32_t face = candidates_.faces[f];
    const FaceCorners corners = surfaces_.corners(face, points_);
    const Point& normal = normals_[face];
    const bool may_be_behind =
        !is_in_front(corners, normal, point) &&
        std::any_of(around.begin(), around.end(), [&](std::uint32_t own) { return dot(normals_[own], normal) < largest_cosine; });
    if (!may_be_behind) {
      smallest_square = smaller_square_m2(smallest_square, corners, point);
      continue;
    }
    const NearestOnFace nearest = nearest_on_face(corners, point);
    if (dot(difference(point, nearest.point), normal) < 0.0) return 0.0;
    smallest_square = std::min(smallest_square, nearest.distance_square_m2);
  }
  return std::sqrt(smallest_square);
}

std::optional<SelfContact::Found> SelfContact::touch_of(std::size_t candidate, const ContactPast* past) const {
  const std::size_t node = candidates_.nodes[candidate];
  const std::size_t first = candidates_.offsets[candidate];
  const auto faces = std::span(candidates_.faces).subspan(first, candidates_.offsets[candidate + 1] - first);
  const std::optional<NodeDepth> depth = depth_of(surfaces_, node, faces, {points_, normals_}, largest_seen_depth_m());
  if (!depth) return std::nullopt;
  const double spring = spring_N_per_m(node, depth->face, depth->nearest.weights);
  Found found{{surfaces_.mesh_node(node),
               static_cast<std::uint32_t>(surfaces_.surface(node)),
               {},
               depth->nearest.weights,
               depth->behind_m,
               spring},
              memory_behind(node, depth->face, norm(depth->behind_m), spring, past)};
  for (std::size_t c = 0; c < 4; ++c) found.touch.face_nodes[c] = surfaces_.mesh_node(surfaces_.face(depth->face)[c]);
  found.touch.pressed_m = found.memory.pressed_m;
  if (past != nullptr && !friction_forces_.empty()) add_friction(found, *past);
  return found;
}

double SelfContact::spring_N_per_m(std::size_t node, std::size_t face, const std::array<double, 4>& weights) const {
  const double of_area = 0.5 * stiffness_ * surfaces_.area_m2(node);
  if (lightness_per_kg_.empty()) return of_area;
  double lightness = lightness_per_kg_[node];
  for (std::size_t c = 0; c < 4; ++c) lightness += weights[c] * weights[c] * lightness_per_kg_[surfaces_.face(face)[c]];
  return std::min(of_area, largest_per_s2_ / lightness);
}

ContactMemory SelfContact::memory_behind(std::size_t node, std::size_t face, double depth_m, double spring_N_per_m,
                                         const ContactPast* past) const {
  const auto node_number = static_cast<std::uint32_t>(node);
  const auto face_number = static_cast<std::uint32_t>(face);
  if (past == nullptr) return {node_number, face_number, depth_m, depth_m, depth_m * depth_m, spring_N_per_m};
  const ContactMemory* before = memory_of(past->memories, node);
  double path_m = no_path * surfaces_.shortest_edge_m() + path_past_face_m(surfaces_, node, face, *past);
  if (before != nullptr && before->face != face)
    path_m = std::max(path_m, path_past_face_m(surfaces_, node, before->face, *past));
  ContactMemory memory =
      memory_after(with_spring(before != nullptr ? *before : ContactMemory{}, spring_N_per_m), depth_m, path_m);
  memory.node = node_number;
  memory.face = face_number;
  return memory;
}

void SelfContact::add_friction(Found& found, const ContactPast& past) const {
  const auto displacement_of = [&](std::size_t node) {
    return scaled(past.step_s, surfaces_.point(node, past.velocities_m_per_s));
  };
  const auto& face = surfaces_.face(found.memory.face);
  const PressedNode pressed{surfaces_.corners(found.memory.face, points_), found.touch.weights, found.touch.behind_m};
  const std::array<Point, 4> moved{displacement_of(face[0]), displacement_of(face[1]), displacement_of(face[2]),
                                   displacement_of(face[3])};
  found.touch.friction_N =
      friction_force_N(friction_, pressed, path_along_face_m(pressed, displacement_of(found.memory.node), moved),
                       face_turn_rad(pressed.corners, moved), found.touch.spring_N_per_m, found.memory);
  found.touch.face_friction_N = face_reactions_N(pressed, found.touch.friction_N);
}

bool SelfContact::can_have(std::span<const ContactMemory> memories) const {
  std::size_t next_node = 0;
  for (const auto& [node, face, depth, pressed, paid, spring, slip, is_sliding] : memories) {
    if (node < next_node || node >= surfaces_.node_count() || face >= surfaces_.face_count()) return false;
    for (const double number : {depth, pressed, paid, spring, slip[0], slip[1], slip[2]})
      if (!std::isfinite(number)) return false;
    next_node = std::size_t{node} + 1;
  }
  return true;
}

/// Sets the memories of the nodes that are behind a face now, and of those that were before and whose springs may still hold some
/// length (paid_m2).
void SelfContact::set_memories(const ContactPast* past) {
  memories_.clear();
  auto found = found_.begin();
  const auto add_found_before = [&](std::size_t node) {
    for (; found != found_.end(); ++found) {
      if (!*found) continue;
      if ((*found)->memory.node >= node) return;
      memories_.push_back((*found)->memory);
    }
  };
  if (past != nullptr) {
    const double edge = surfaces_.shortest_edge_m();
    for (const ContactMemory& before : past->memories) {
      add_found_before(before.node);
      if (found != found_.end() && (*found)->memory.node == before.node) continue;
      const double path_m = no_path * edge + path_past_face_m(surfaces_, before.node, before.face, *past);
      ContactMemory memory = memory_after(before, 0.0, path_m);
      memory.slip_m = {};
      memory.is_sliding = false;
      if (memory.paid_m2 > nothing_paid * edge * edge) memories_.push_back(memory);
    }
  }
  add_found_before(surfaces_.node_count());
}

void SelfContact::set_forces() {
  const auto clear = [&](std::size_t node) {
    for (std::size_t i = 0; i < 3; ++i) {
      forces_[3 * node + i] = 0.0;
      if (!friction_forces_.empty()) friction_forces_[3 * node + i] = 0.0;
    }
  };
  for (const SelfTouch& touch : touches_) {
    clear(touch.node);
    for (const std::uint32_t node : touch.face_nodes) clear(node);
  }
  touches_.clear();
  const auto add = [](std::vector<double>& forces, std::size_t node, const Point& force) {
    for (std::size_t i = 0; i < 3; ++i) forces[3 * node + i] += force[i];
  };
  for (const auto& found : found_) {
    if (!found) continue;
    const SelfTouch& touch = touches_.emplace_back(found->touch);
    const double depth = found->memory.depth_m;
    const Point push = scaled(-touch.spring_N_per_m * touch.pressed_m / depth, touch.behind_m);
    add(forces_, touch.node, push);
    for (std::size_t c = 0; c < 4; ++c) add(forces_, touch.face_nodes[c], scaled(-touch.weights[c], push));
    largest_depth_ = std::max(largest_depth_, depth);
    if (friction_forces_.empty()) continue;
    add(friction_forces_, touch.node, touch.friction_N);
    for (std::size_t c = 0; c < 4; ++c) add(friction_forces_, touch.face_nodes[c], touch.face_friction_N[c]);
  }
}

std::span<const double> SelfContact::forces_N() const { return touches_.empty() ? std::span<const double>{} : forces_; }

std::span<const double> SelfContact::friction_N() const {
  return touches_.empty() ? std::span<const double>{} : friction_forces_;
}

double SelfContact::energy_J() const {
  double energy = 0.0;
  for (const SelfTouch& touch : touches_) energy += 0.5 * touch.spring_N_per_m * touch.pressed_m * touch.pressed_m;
  return energy;
}

}  // namespace menger::fem
