#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "fem/thin_walls/thin_wall_kernel.h"
#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// The place of an element in a body of thin walls.
struct ThinWallPlace {
  ThinWallElement element = ThinWallElement::block;
  std::size_t normal = 2;  ///< axis of the thickness of a wall: 0, 1, 2 for x, y, z; of no meaning for blocks
  /// The plena behind the two faces of a wall, the larger one first; -1: the outside. -1 for blocks.
  std::array<int, 2> plena{-1, -1};

  bool operator==(const ThinWallPlace&) const = default;
  bool operator<(const ThinWallPlace& other) const {
    return std::tie(element, normal, plena) < std::tie(other.element, other.normal, other.plena);
  }
};

/// Returns the place of every element. An element is a wall if both of its faces across exactly one axis are free: they bound the
/// body and are no plane of symmetry. All others are blocks: edges and corners, where walls meet; solid parts, and walls of
/// several layers, which have elements behind a face; thin bars, which are free across two axes.
std::vector<ThinWallPlace> thin_wall_places(const meshes::HexahedralMesh& mesh);

/// Consecutive batches of elements of one kind and region.
struct ThinWallGroup {
  ThinWallElement element = ThinWallElement::wall;
  std::size_t region = 0;
  std::size_t first_batch = 0;
  std::size_t batch_count = 0;
};

/// A mesh of boxes along the axes as walls and blocks, in batches for kernels of `width` lanes. The elements of a batch have the
/// same region, kind, normal and plena. The lanes at the end of a batch that have no element repeat its last one with a volume of
/// zero; their forces are never read.
class ThinWallMesh {
 public:
  /// Sorts the elements of a mesh into batches.
  /// @param mixes_plena true: the walls of a batch may have different plena, see plena_of_lane; fewer lanes are then repeated
  /// @throws io::InputError naming the first element that is no box along the axes
  ThinWallMesh(const meshes::HexahedralMesh& mesh, std::size_t width, bool mixes_plena = false);

  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t batch_count() const { return normals_.size(); }
  [[nodiscard]] std::size_t lane_count() const { return elements_.size(); }
  [[nodiscard]] const std::vector<ThinWallGroup>& groups() const { return groups_; }

  /// Returns the element of the mesh in a lane; lanes are counted over all batches.
  [[nodiscard]] std::size_t element(std::size_t lane) const { return elements_[lane]; }
  [[nodiscard]] bool is_repeated(std::size_t lane) const { return edges_m_[lane][0] == 0.0; }
  /// The shape of the element in a lane, see shape_of; its volume is 0 where it is repeated.
  [[nodiscard]] std::array<double, shape_numbers_per_lane> shape(std::size_t lane) const;
  /// Three times the nodes of the eight corners of a lane, in the order that kernels take.
  [[nodiscard]] std::span<const std::uint32_t> first_components(std::size_t lane) const {
    return std::span(first_components_).subspan(8 * lane, 8);
  }
  [[nodiscard]] std::size_t normal(std::size_t batch) const { return normals_[batch]; }
  /// See ThinWallPlace::plena. Precondition: batches do not mix plena.
  [[nodiscard]] const std::array<int, 2>& plena(std::size_t batch) const { return plena_of_lane(width_ * batch); }
  [[nodiscard]] const std::array<int, 2>& plena_of_lane(std::size_t lane) const { return plena_[lane]; }
  /// How many of the plena of a batch are not the outside.
  [[nodiscard]] std::size_t plenum_count(std::size_t batch) const {
    return static_cast<std::size_t>(
        std::count_if(plena(batch).begin(), plena(batch).end(), [](int plenum) { return plenum >= 0; }));
  }
  /// At which end of its normal a wall has the first of its plena: 1 the upper, -1 the lower one.
  [[nodiscard]] int side(std::size_t lane) const { return sides_[lane]; }

  /// Returns batches without shapes and pressures, which depend on the number type.
  template <class Number>
  [[nodiscard]] ThinWallBatches<Number> batches(ThinWallElement element, std::size_t first, std::size_t count) const {
    ThinWallBatches<Number> result;
    result.element = element;
    result.count = count;
    result.first_components = first_components_.data() + 8 * width_ * first;
    result.normals = normals_.data() + first;
    return result;
  }

 private:
  void add_lane(const meshes::HexahedralMesh& mesh, std::size_t element, std::size_t normal);

  std::size_t width_;
  std::vector<ThinWallGroup> groups_;
  std::vector<std::size_t> elements_;
  std::vector<std::array<double, 3>> edges_m_;  ///< l1, l2, l3 per lane; l1 is 0 where an element is repeated
  std::vector<std::uint32_t> first_components_;
  std::vector<std::uint8_t> normals_;
  std::vector<std::array<int, 2>> plena_;  ///< per lane
  std::vector<int> sides_;
};

/// Where the branches of the elements of a body lie in one array: entry n of a lane at first(lane) + n width.
class ThinWallBranchLayout {
 public:
  explicit ThinWallBranchLayout(const ThinWallMesh& walls);

  [[nodiscard]] std::size_t number_count() const { return number_count_; }  ///< of the array
  /// The first number of a group's first batch.
  [[nodiscard]] std::size_t position(std::size_t group) const { return positions_[group]; }
  /// Returns the first number of a lane. @param group that of the lane, which is counted over all batches
  [[nodiscard]] std::size_t first(std::size_t group, std::size_t lane) const;

 private:
  const ThinWallMesh& walls_;
  std::vector<std::size_t> positions_;
  std::size_t number_count_ = 0;
};

/// Returns those faces of walls, by their sorted corners, that lie across the wall and bound a chamber.
std::set<meshes::FaceCorners> chamber_faces_of_walls(const meshes::HexahedralMesh& mesh);

}  // namespace menger::fem
