#include "fem/contact/body_overlap.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <limits>
#include <vector>

#include "fem/surfaces/face_tree.h"
#include "fem/surfaces/point.h"
#include "io/text/formatted.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::fem {
namespace {

constexpr std::size_t most_bins = 64;  // along an axis
constexpr double least_sine = 1e-3;    // smallest sine of the angle between two edges that count as not parallel

bool meet(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!(a.high[i] > b.low[i] && b.high[i] > a.low[i])) return false;
  return true;
}

/// Sorts boxes by their lower corners into bins of equal size. No box is larger than a bin, so boxes that meet are in the same
/// bin or in neighbouring bins.
class BoxBins {
 public:
  explicit BoxBins(std::span<const Box> boxes) {
    Box all;
    Point size{};
    for (const Box& box : boxes) {
      all.add(box.low);
      for (std::size_t i = 0; i < 3; ++i) size[i] = std::max(size[i], box.high[i] - box.low[i]);
    }
    low_ = all.low;
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = all.high[i] - all.low[i];
      count_[i] = static_cast<std::size_t>(std::clamp(length / size[i], 1.0, static_cast<double>(most_bins)));
      per_m_[i] = length > 0.0 ? static_cast<double>(count_[i]) / length : 0.0;
    }
    fill(boxes);
  }

  /// Calls consider(first, second) once for each pair of boxes that meet, first < second.
  template <class Consider>
  void visit_pairs(const Consider& consider) const {
    for (std::size_t bin = 0; bin + 1 < offsets_.size(); ++bin) {
      const std::size_t x = bin % count_[0];
      const std::size_t y = bin / count_[0] % count_[1];
      const std::size_t z = bin / count_[0] / count_[1];
      const std::size_t before = x > 0 ? 1 : 0;
      const std::size_t after = x + 1 < count_[0] ? 1 : 0;
      for (std::size_t n = offsets_[bin]; n < offsets_[bin + 1]; ++n) {
        const auto visit = [&](std::size_t begin, std::size_t end) {
          for (std::size_t m = begin; m < end; ++m)
            if (meet(boxes_[n], boxes_[m])) consider(std::min(elements_[n], elements_[m]), std::max(elements_[n], elements_[m]));
        };
        const auto visit_row = [&](std::size_t of_row) { visit(offsets_[of_row - before], offsets_[of_row + after + 1]); };
        // Of two neighbouring bins, only the first looks at the other one.
        visit(n + 1, offsets_[bin + after + 1]);
        if (y + 1 < count_[1]) visit_row(bin + count_[0]);
        if (z + 1 == count_[2]) continue;
        for (std::size_t j = y > 0 ? y - 1 : 0; j < std::min(y + 2, count_[1]); ++j)
          visit_row(((z + 1) * count_[1] + j) * count_[0] + x);
      }
    }
  }

 private:
  [[nodiscard]] std::array<std::size_t, 3> place_of(const Box& box) const {
    std::array<std::size_t, 3> place{};
    for (std::size_t i = 0; i < 3; ++i)
      place[i] = std::min(static_cast<std::size_t>((box.low[i] - low_[i]) * per_m_[i]), count_[i] - 1);
    return place;
  }
  [[nodiscard]] std::size_t bin_of(const Box& box) const {
    const auto [x, y, z] = place_of(box);
    return (z * count_[1] + y) * count_[0] + x;
  }
  void fill(std::span<const Box> boxes) {
    offsets_.assign(count_[0] * count_[1] * count_[2] + 1, 0);
    for (const Box& box : boxes) ++offsets_[bin_of(box) + 1];
    for (std::size_t bin = 1; bin < offsets_.size(); ++bin) offsets_[bin] += offsets_[bin - 1];
    std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
    elements_.resize(boxes.size());
    boxes_.resize(boxes.size());
    for (std::size_t element = 0; element < boxes.size(); ++element) {
      const std::size_t n = next[bin_of(boxes[element])]++;
      elements_[n] = element;
      boxes_[n] = boxes[element];
    }
  }

  Point low_{};
  std::array<std::size_t, 3> count_{};
  Point per_m_{};
  std::vector<std::size_t> offsets_;   // of bins, x fastest
  std::vector<std::size_t> elements_;  // bin by bin
  std::vector<Box> boxes_;             // of these
};

/// An element at its present position.
struct Hull {
  meshes::CornerPoints corners{};
  std::array<Point, 6> normals{};  ///< of the faces, not normalised
  std::array<Point, 3>
      directions{};  ///< mean direction of the edges along each axis of the element, of length 1; 0 where they cancel
  double thickness = 0.0;
};

Point unit(const Point& a) {
  const double length = norm(a);
  return length > 0.0 ? scaled(1.0 / length, a) : Point{};
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Range range_along(const Point& direction, const Hull& hull) {
  Range range;
  for (const Point& corner : hull.corners) {
    const double at = dot(direction, corner);
    range.low = std::min(range.low, at);
    range.high = std::max(range.high, at);
  }
  return range;
}

Hull hull_of(const meshes::CornerPoints& corners) {
  Hull hull{.corners = corners};
  for (std::size_t f = 0; f < 6; ++f) {
    const auto& [a, b, c, d] = meshes::face_corners[f];
    hull.normals[f] = cross(difference(corners[c], corners[a]), difference(corners[d], corners[b]));
  }
  for (std::size_t e = 0; e < meshes::edge_corners.size(); ++e) {
    const auto& [from, to] = meshes::edge_corners[e];
    hull.directions[e / 4] = sum(hull.directions[e / 4], difference(corners[to], corners[from]));
  }
  for (Point& direction : hull.directions) direction = unit(direction);
  hull.thickness = std::numeric_limits<double>::infinity();
  for (const Point& normal : hull.normals) {
    const double length = norm(normal);
    if (length == 0.0) continue;
    const auto [low, high] = range_along(normal, hull);
    hull.thickness = std::min(hull.thickness, (high - low) / length);
  }
  return hull;
}

/// The overlap of two hulls along a direction of the given length; negative if they are apart.
double depth_along(const Point& direction, double length, const Hull& a, const Hull& b) {
  const auto [low_a, high_a] = range_along(direction, a);
  const auto [low_b, high_b] = range_along(direction, b);
  return std::min(high_a - low_b, high_b - low_a) / length;
}

/// The depth by which two hulls overlap. Where it is not more than `enough_m`, the search stops early and the result is some
/// number that is also not more than it.
double depth_between(const Hull& a, const Hull& b, double enough_m) {
  double depth = std::numeric_limits<double>::infinity();
  const auto is_enough = [&](const Point& direction, double least_length) {
    const double length = norm(direction);
    if (length > least_length) depth = std::min(depth, depth_along(direction, length, a, b));
    return depth <= enough_m;
  };
  for (const Hull* hull : {&a, &b})
    for (const Point& normal : hull->normals)
      if (is_enough(normal, 0.0)) return depth;
  for (const Point& of_a : a.directions)
    for (const Point& of_b : b.directions)
      if (is_enough(cross(of_a, of_b), least_sine)) return depth;
  return depth;
}

meshes::CornerPoints current_corners(const meshes::HexahedralMesh& mesh, std::size_t element,
                                     std::span<const double> displacements_m) {
  meshes::CornerPoints corners;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const std::size_t node = mesh.elements[element][c];
    for (std::size_t i = 0; i < 3; ++i) corners[c][i] = mesh.points[node][i] + displacements_m[3 * node + i];
  }
  return corners;
}

/// The hulls of those elements that were asked for; few are.
class Hulls {
 public:
  Hulls(const meshes::HexahedralMesh& mesh, std::span<const double> displacements_m)
      : mesh_(mesh), displacements_(displacements_m), of_element_(mesh.elements.size(), nullptr) {}

  /// Returns the hull of an element, which stays where it is.
  const Hull& of(std::size_t element) {
    const Hull*& hull = of_element_[element];
    if (hull == nullptr) hull = &hulls_.emplace_back(hull_of(current_corners(mesh_, element, displacements_)));
    return *hull;
  }

 private:
  const meshes::HexahedralMesh& mesh_;
  std::span<const double> displacements_;
  std::deque<Hull> hulls_;
  std::vector<const Hull*> of_element_;  ///< nullptr: not asked for yet
};

}  // namespace

BodyOverlapSearch::BodyOverlapSearch(const meshes::HexahedralMesh& mesh) : mesh_(mesh), neighbours_(mesh.elements.size()) {
  std::vector<std::vector<std::uint32_t>> elements_at(mesh.points.size());
  for (std::size_t element = mesh.elements.size(); element-- > 0;) {
    std::vector<std::uint32_t>& neighbours = neighbours_[element];
    for (const std::size_t node : mesh.elements[element]) {
      neighbours.insert(neighbours.end(), elements_at[node].begin(), elements_at[node].end());
      elements_at[node].push_back(static_cast<std::uint32_t>(element));
    }
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  }
}

/// @param second greater than the first
bool BodyOverlapSearch::share_a_node(std::size_t first, std::size_t second) const {
  const std::vector<std::uint32_t>& neighbours = neighbours_[first];
  return std::binary_search(neighbours.begin(), neighbours.end(), static_cast<std::uint32_t>(second));
}

std::optional<BodyOverlap> BodyOverlapSearch::find(std::span<const double> displacements_m, double share) const {
  assert(displacements_m.size() == 3 * mesh_.points.size());
  std::vector<Box> boxes(mesh_.elements.size());
  for (std::size_t e = 0; e < boxes.size(); ++e)
    for (const Point& corner : current_corners(mesh_, e, displacements_m)) boxes[e].add(corner);
  Hulls hulls(mesh_, displacements_m);
  BodyOverlap found;
  BoxBins(boxes).visit_pairs([&](std::size_t first, std::size_t second) {
    if (share_a_node(first, second)) return;
    const Hull& a = hulls.of(first);
    const Hull& b = hulls.of(second);
    const double thinner = std::min(a.thickness, b.thickness);
    const double depth = depth_between(a, b, share * thinner);
    if (!(depth > share * thinner)) return;
    ++found.pairs;
    const double of_thinner = depth / thinner;
    const std::array pair{first, second};
    if (of_thinner < found.share || (of_thinner == found.share && found.elements < pair)) return;
    found.share = of_thinner;
    found.depth_m = depth;
    found.elements = pair;
  });
  if (found.pairs == 0) return std::nullopt;
  return found;
}

std::string BodyOverlapSearch::text_of(const BodyOverlap& overlap) const {
  const auto place = [&](std::size_t n) { return meshes::millimetre_text(mesh_.points[mesh_.elements[overlap.elements[n]][0]]); };
  return "walls went through each other: " + std::to_string(overlap.pairs) + (overlap.pairs == 1 ? " pair" : " pairs") +
         " of elements; the largest overlap relative to the thickness is between those that rest at " + place(0) + " and " +
         place(1) + ": " + io::formatted("%.3g", 1e3 * overlap.depth_m) + " mm or " + io::formatted("%.2g", overlap.share) +
         " of the thickness of the thinner one";
}

}  // namespace menger::fem
