#include "fem/boxes/box_mesh.h"

#include <string>

#include "io/text/input_error.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::fem {
namespace {

meshes::Point box_edges(const meshes::HexahedralMesh& mesh, std::size_t element) {
  const meshes::CornerPoints corners = meshes::corner_points(mesh, element);
  if (const auto edges = meshes::box_edges(corners)) return *edges;
  throw io::InputError("explicit dynamics: element " + std::to_string(element) + " at " + meshes::millimetre_text(corners[0]) +
                       " is not a box along the axes");
}

}  // namespace

BoxMesh::BoxMesh(const meshes::HexahedralMesh& mesh, std::size_t width) : width_(width), element_count_(mesh.elements.size()) {
  for (std::size_t region = 0; region < mesh.region_names.size(); ++region) add_group(mesh, region);
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> first_component;
  for (std::size_t lane = 0; lane < elements_.size(); ++lane) {
    if (volumes_[lane] == 0.0) continue;
    const std::size_t batch = lane / width_;
    for (std::size_t c = 0; c < 8; ++c) {
      nodes.push_back(first_components_[8 * lane + c] / 3);
      first_component.push_back(static_cast<std::uint32_t>((24 * batch + 3 * c) * width_ + lane % width_));
    }
  }
  slots_ = sorted_by_node(nodes, first_component, mesh.points.size(), width_);
}

void BoxMesh::add_group(const meshes::HexahedralMesh& mesh, std::size_t region) {
  const std::size_t first_batch = batch_count();
  std::size_t last = mesh.elements.size();
  for (std::size_t element = 0; element < mesh.elements.size(); ++element) {
    if (mesh.regions[element] != region) continue;
    add_lane(mesh, element, false);
    last = element;
  }
  if (last == mesh.elements.size()) return;
  while (elements_.size() % width_ != 0) add_lane(mesh, last, true);
  groups_.push_back({region, first_batch, batch_count() - first_batch});
}

void BoxMesh::add_lane(const meshes::HexahedralMesh& mesh, std::size_t element, bool repeated) {
  const meshes::Point edges = box_edges(mesh, element);
  const std::size_t lane = elements_.size();
  if (lane % width_ == 0) {
    inverse_edges_.resize(inverse_edges_.size() + 3 * width_);
    volumes_.resize(volumes_.size() + width_);
  }
  elements_.push_back(element);
  for (std::size_t i = 0; i < 3; ++i) inverse_edges_[(3 * (lane / width_) + i) * width_ + lane % width_] = 1.0 / edges[i];
  volumes_[lane] = repeated ? 0.0 : edges[0] * edges[1] * edges[2];
  for (const std::size_t point : mesh.elements[element]) first_components_.push_back(static_cast<std::uint32_t>(3 * point));
}

BoxBatches BoxMesh::batches(std::size_t first, std::size_t count) const {
  return {count, first_components_.data() + 8 * width_ * first, inverse_edges_.data() + 3 * width_ * first,
          volumes_.data() + width_ * first};
}

}  // namespace menger::fem
