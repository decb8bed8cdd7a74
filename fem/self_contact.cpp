#include "fem/self_contact.h"

#include <algorithm>
#include <cmath>

#include "fem/self_contact_depth.h"

namespace menger::fem {
namespace {

constexpr std::size_t candidates_per_block = 32;
std::vector<double> positions_of(const meshes::HexahedralMesh& mesh) {
  std::vector<double> positions;
  positions.reserve(3 * mesh.points.size());
  for (const meshes::Point& point : mesh.points) positions.insert(positions.end(), point.begin(), point.end());
  return positions;
}

}  // namespace

SelfContact::SelfContact(const meshes::HexahedralMesh& mesh, double stiffness_Pa_per_m, bool with_outside)
    : surfaces_(mesh, with_outside),
      search_(surfaces_, surfaces_.points(positions_of(mesh))),
      stiffness_(stiffness_Pa_per_m),
      normals_(surfaces_.face_count()),
      forces_(3 * mesh.points.size(), 0.0) {}

void SelfContact::moved(double travel_m) {
  travel_ += travel_m;
  if (is_near_) largest_travel_ = std::max(largest_travel_, travel_m);
}

void SelfContact::forget() {
  allowance_ = 0.0;
  travel_ = 0.0;
}

void SelfContact::watch() {
  largest_depth_ = 0.0;
  largest_travel_ = 0.0;
}

void SelfContact::find_touches(std::span<const double> positions_m, const BlockLoop& loop) {
  if (must_search()) search(positions_m, loop);
  if (!is_near_ && touches_.empty()) return;
  for (const std::uint32_t node : followed_nodes_) points_[node] = surfaces_.point(node, positions_m);
  for (const std::uint32_t face : followed_faces_) {
    const Point area = area_vector(surfaces_.corners(face, points_));
    const double size = norm(area);
    normals_[face] = size > 0.0 ? scaled(1.0 / size, area) : Point{};
  }
  loop.run(found_.size(), candidates_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) found_[n] = touch_of(n);
  });
  set_forces();
}

void SelfContact::search(std::span<const double> positions_m, const BlockLoop& loop) {
  points_ = surfaces_.points(positions_m);
  candidates_ = search_.near_pairs(points_, reach_m(), loop);
  // From far away it is cheaper to look again when the nearest pair may have met than to follow all pairs at each step.
  is_near_ = candidates_.smallest_m < 0.5 * reach_m();
  allowance_ = is_near_ ? reach_m() : candidates_.smallest_m;
  travel_ = 0.0;
  found_.assign(is_near_ ? candidates_.nodes.size() : 0, std::nullopt);
  ++searches_;
  follow_candidates();
}

void SelfContact::follow_candidates() {
  const auto make_unique = [](std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  };
  followed_faces_.clear();
  followed_nodes_.clear();
  if (!is_near_) return;
  // A nearest point on the rim of a face makes its neighbours count, too.
  for (const std::uint32_t face : candidates_.faces)
    for (const std::uint32_t node : surfaces_.face(face))
      followed_faces_.insert(followed_faces_.end(), surfaces_.faces_around(node).begin(), surfaces_.faces_around(node).end());
  for (const std::uint32_t node : candidates_.nodes)
    followed_faces_.insert(followed_faces_.end(), surfaces_.faces_around(node).begin(), surfaces_.faces_around(node).end());
  make_unique(followed_faces_);
  for (const std::uint32_t face : followed_faces_)
    followed_nodes_.insert(followed_nodes_.end(), surfaces_.face(face).begin(), surfaces_.face(face).end());
  make_unique(followed_nodes_);
}

std::optional<SelfTouch> SelfContact::touch_of(std::size_t candidate) const {
  const std::size_t node = candidates_.nodes[candidate];
  const std::size_t first = candidates_.offsets[candidate];
  const auto faces = std::span(candidates_.faces).subspan(first, candidates_.offsets[candidate + 1] - first);
  const std::optional<NodeDepth> depth = depth_of(surfaces_, node, faces, {points_, normals_}, largest_seen_depth_m());
  if (!depth) return std::nullopt;
  SelfTouch touch{surfaces_.mesh_node(node), static_cast<std::uint32_t>(surfaces_.surface(node)), {}, depth->nearest.weights,
                  depth->behind_m,           0.5 * stiffness_ * surfaces_.area_m2(node)};
  for (std::size_t c = 0; c < 4; ++c) touch.face_nodes[c] = surfaces_.mesh_node(surfaces_.face(depth->face)[c]);
  return touch;
}

void SelfContact::set_forces() {
  const auto clear = [&](std::size_t node) { std::fill_n(forces_.begin() + static_cast<std::ptrdiff_t>(3 * node), 3, 0.0); };
  for (const SelfTouch& touch : touches_) {
    clear(touch.node);
    for (const std::uint32_t node : touch.face_nodes) clear(node);
  }
  touches_.clear();
  for (const auto& found : found_) {
    if (!found) continue;
    touches_.push_back(*found);
    for (std::size_t i = 0; i < 3; ++i) {
      const double force = -found->spring_N_per_m * found->behind_m[i];
      forces_[3 * std::size_t{found->node} + i] += force;
      for (std::size_t c = 0; c < 4; ++c) forces_[3 * std::size_t{found->face_nodes[c]} + i] -= found->weights[c] * force;
    }
    largest_depth_ = std::max(largest_depth_, norm(found->behind_m));
  }
}

std::span<const double> SelfContact::forces_N() const { return touches_.empty() ? std::span<const double>{} : forces_; }

double SelfContact::energy_J() const {
  double energy = 0.0;
  for (const SelfTouch& touch : touches_) energy += 0.5 * touch.spring_N_per_m * dot(touch.behind_m, touch.behind_m);
  return energy;
}

double SelfContact::stiffness_per_s2(std::span<const double> masses_kg) const {
  // The springs of one touch are spring times g g^T with |g| = 1 at the node and the weights at the face: a row's blocks add up
  // to 2 times its own |g|.
  if (touches_.empty()) return 0.0;
  std::vector<double> rows(forces_.size() / 3, 0.0);
  for (const SelfTouch& touch : touches_) {
    rows[touch.node] += 2.0 * touch.spring_N_per_m;
    for (std::size_t c = 0; c < 4; ++c) rows[touch.face_nodes[c]] += 2.0 * touch.weights[c] * touch.spring_N_per_m;
  }
  double largest = 0.0;
  for (std::size_t node = 0; node < rows.size(); ++node) largest = std::max(largest, rows[node] / masses_kg[node]);
  return largest;
}

}  // namespace menger::fem
