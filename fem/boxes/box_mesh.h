#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fem/boxes/aligned_numbers.h"
#include "fem/boxes/explicit_kernel.h"
#include "fem/boxes/node_slots.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Consecutive batches of elements of one region.
struct BoxGroup {
  std::size_t region = 0;
  std::size_t first_batch = 0;
  std::size_t batch_count = 0;
};

/// A mesh whose elements are boxes along the axes, in batches for kernels of `width` lanes. The lanes at the end of a group that
/// have no element repeat its last one with a volume of zero; their forces are never read.
class BoxMesh {
 public:
  /// Sorts the elements of a mesh into batches.
  /// @throws io::InputError naming the first element that is no box along the axes
  BoxMesh(const meshes::HexahedralMesh& mesh, std::size_t width);

  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t element_count() const { return element_count_; }
  [[nodiscard]] std::size_t batch_count() const { return elements_.size() / width_; }
  [[nodiscard]] const std::vector<BoxGroup>& groups() const { return groups_; }
  [[nodiscard]] const NodeSlots& slots() const { return slots_; }

  [[nodiscard]] BoxBatches batches(std::size_t first, std::size_t count) const;

  /// Returns the element of the mesh in a lane; lanes are counted over all batches.
  [[nodiscard]] std::size_t element(std::size_t lane) const { return elements_[lane]; }
  [[nodiscard]] std::span<const std::uint32_t> first_components(std::size_t lane) const {
    return std::span(first_components_).subspan(8 * lane, 8);
  }

 private:
  void add_group(const meshes::HexahedralMesh& mesh, std::size_t region);
  void add_lane(const meshes::HexahedralMesh& mesh, std::size_t element, bool repeated);

  std::size_t width_;
  std::size_t element_count_ = 0;
  std::vector<BoxGroup> groups_;
  std::vector<std::size_t> elements_;
  std::vector<std::uint32_t> first_components_;
  AlignedNumbers inverse_edges_;
  AlignedNumbers volumes_;
  NodeSlots slots_;
};

}  // namespace menger::fem
