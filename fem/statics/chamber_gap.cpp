#include "fem/statics/chamber_gap.h"

#include <algorithm>
#include <limits>
#include <map>

namespace menger::fem {

ChamberGaps::ChamberGaps(const Space& space, const Body& body) : space_(space) {
  const std::size_t n = space.nodes_per_face();
  std::vector<int> chambers;
  std::vector<Index> global;
  for (const SpaceFace& face : space.faces) {
    for (std::size_t c = 0; c < body.chambers.size(); ++c) {
      const auto& labels = body.chambers[c].labels;
      if (std::find(labels.begin(), labels.end(), face.label) == labels.end()) continue;
      chambers.push_back(static_cast<int>(c));
      for (std::size_t a = 0; a < n; ++a) {
        own_nodes_.push_back(face.nodes[a]);
        global.push_back(space.global_node(face.nodes[a]));
      }
    }
  }
  const std::vector<int> all_chambers = gather_on_first(space.communicator, MPI_INT, chambers, shares_);
  const std::vector<Index> all_global = gather_on_first(space.communicator, MPI_INT, global, shares_);
  std::map<Index, std::size_t> first;
  first_of_.resize(all_global.size());
  for (std::size_t g = 0; g < all_global.size(); ++g) first_of_[g] = first.try_emplace(all_global[g], g).first->second;
  faces_.resize(body.chambers.size());
  for (std::size_t f = 0; f < all_chambers.size(); ++f) {
    std::array<std::size_t, 9> face{};
    for (std::size_t a = 0; a < n; ++a) face[a] = first_of_[f * n + a];
    faces_[static_cast<std::size_t>(all_chambers[f])].push_back(face);
  }
  for (std::size_t r = 0; r < shares_.counts.size(); ++r) {
    shares_.counts[r] *= 3;
    shares_.offsets[r] *= 3;
  }

  const std::vector<Point> nodes = gather(std::vector<double>(3 * space.positions.size(), 0.0));
  depth_m_ = std::numeric_limits<double>::max();
  for (const auto& faces : faces_) {
    if (faces.empty()) continue;
    Point least = nodes[faces[0][0]];
    Point most = least;
    for (const auto& face : faces) {
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t i = 0; i < 3; ++i) {
          least[i] = std::min(least[i], nodes[face[a]][i]);
          most[i] = std::max(most[i], nodes[face[a]][i]);
        }
      }
      const std::size_t degree = n == 4 ? 1 : 2;
      depth_m_ = std::min({depth_m_, 0.5 * norm(difference(nodes[face[degree]], nodes[face[0]])),
                           0.5 * norm(difference(nodes[face[degree * (degree + 1)]], nodes[face[0]]))});
    }
    size_m_ = std::max(size_m_, norm(difference(most, least)));
  }
  std::array<double, 2> sizes{size_m_, depth_m_};
  MPI_Bcast(sizes.data(), 2, MPI_DOUBLE, 0, space.communicator);
  size_m_ = sizes[0];
  depth_m_ = sizes[1];
}

std::vector<Point> ChamberGaps::gather(std::span<const double> displacements) const {
  std::vector<double> own;
  own.reserve(3 * own_nodes_.size());
  for (const Index node : own_nodes_) {
    const auto at = static_cast<std::size_t>(node);
    for (std::size_t i = 0; i < 3; ++i) own.push_back(space_.positions[at][i] + displacements[3 * at + i]);
  }
  std::vector<double> all(3 * first_of_.size());
  MPI_Gatherv(own.data(), static_cast<int>(own.size()), MPI_DOUBLE, all.data(), shares_.counts.data(), shares_.offsets.data(),
              MPI_DOUBLE, 0, space_.communicator);
  std::vector<Point> nodes(first_of_.size());
  for (std::size_t g = 0; g < nodes.size(); ++g) nodes[g] = {all[3 * g], all[3 * g + 1], all[3 * g + 2]};
  return nodes;
}

template <std::size_t n>
std::optional<WallGap> ChamberGaps::smallest_of(const std::vector<Point>& nodes) const {
  std::optional<WallGap> least;
  for (const auto& chamber : faces_) {
    std::vector<std::array<std::size_t, n>> faces(chamber.size());
    for (std::size_t f = 0; f < chamber.size(); ++f) std::copy_n(chamber[f].begin(), n, faces[f].begin());
    const auto gap = smallest_wall_gap<n>(faces, nodes, depth_m_, size_m_);
    if (gap && (!least || gap->gap_m < least->gap_m)) least = gap;
  }
  return least;
}

std::optional<WallGap> ChamberGaps::smallest(std::span<const double> displacements) const {
  const std::vector<Point> nodes = gather(displacements);
  const auto found = space_.degree == 1 ? smallest_of<4>(nodes) : smallest_of<9>(nodes);
  WallGap gap = found.value_or(WallGap{});
  int has = found ? 1 : 0;
  MPI_Bcast(&has, 1, MPI_INT, 0, space_.communicator);
  MPI_Bcast(&gap, sizeof gap, MPI_BYTE, 0, space_.communicator);
  return has != 0 ? std::optional(gap) : std::nullopt;
}

}  // namespace menger::fem
