#include "fem/thin_walls/thin_wall_mesh.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "io/text/input_error.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::fem {
namespace {

meshes::FaceCorners face_of(const meshes::ElementCorners& corners, std::size_t side) {
  return meshes::sorted(meshes::face_of_element(corners, side));
}

/// The free faces of a mesh: those that bound the body and are no plane of symmetry. Each with the plenum behind it, or -1.
class FreeFaces {
 public:
  explicit FreeFaces(const meshes::HexahedralMesh& mesh) {
    std::vector<std::optional<int>> plenum_of_label;
    for (const std::string& label : mesh.label_names)
      plenum_of_label.push_back(label.starts_with("symmetry") ? std::optional<int>{} : std::optional(-1));
    for (const meshes::Chamber& chamber : mesh.chambers)
      for (const std::size_t label : chamber.labels) plenum_of_label[label] = static_cast<int>(chamber.plenum);
    for (const meshes::BoundaryFace& face : mesh.faces)
      if (const auto plenum = plenum_of_label[face.label]) plena_[meshes::sorted(face.corners)] = *plenum;
  }

  /// Returns the plenum behind a face of an element, -1 for the outside; empty if the face is not free.
  [[nodiscard]] std::optional<int> plenum(const meshes::ElementCorners& corners, std::size_t side) const {
    const auto found = plena_.find(face_of(corners, side));
    return found == plena_.end() ? std::optional<int>{} : std::optional(found->second);
  }

 private:
  std::map<meshes::FaceCorners, int> plena_;
};

}  // namespace

std::vector<ThinWallPlace> thin_wall_places(const meshes::HexahedralMesh& mesh) {
  const FreeFaces faces(mesh);
  std::vector<ThinWallPlace> places;
  places.reserve(mesh.elements.size());
  for (const meshes::ElementCorners& corners : mesh.elements) {
    ThinWallPlace place;
    std::size_t free_axes = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::optional<int> low = faces.plenum(corners, 2 * axis);
      const std::optional<int> high = faces.plenum(corners, 2 * axis + 1);
      if (!low || !high) continue;
      ++free_axes;
      place = {ThinWallElement::wall, axis, {std::max(*low, *high), std::min(*low, *high)}};
    }
    places.push_back(free_axes == 1 ? place : ThinWallPlace{});
  }
  return places;
}

std::set<meshes::FaceCorners> chamber_faces_of_walls(const meshes::HexahedralMesh& mesh) {
  const FreeFaces faces(mesh);
  const std::vector<ThinWallPlace> places = thin_wall_places(mesh);
  std::set<meshes::FaceCorners> result;
  for (std::size_t element = 0; element < places.size(); ++element) {
    if (places[element].element != ThinWallElement::wall) continue;
    for (const std::size_t end : {0U, 1U}) {
      const std::size_t side = 2 * places[element].normal + end;
      if (faces.plenum(mesh.elements[element], side).value_or(-1) >= 0) result.insert(face_of(mesh.elements[element], side));
    }
  }
  return result;
}

ThinWallMesh::ThinWallMesh(const meshes::HexahedralMesh& mesh, std::size_t width, bool mixes_plena) : width_(width) {
  const std::vector<ThinWallPlace> places = thin_wall_places(mesh);
  const FreeFaces faces(mesh);
  const auto side_of = [&](std::size_t element) {
    const ThinWallPlace& place = places[element];
    const std::optional<int> high = faces.plenum(mesh.elements[element], 2 * place.normal + 1);
    return high && *high == place.plena[0] ? 1 : -1;
  };
  using Key = std::tuple<ThinWallElement, std::size_t, ThinWallPlace>;  // kind, region, place
  std::map<Key, std::vector<std::size_t>> sets;
  for (std::size_t element = 0; element < places.size(); ++element) {
    ThinWallPlace alike = places[element];
    if (mixes_plena) alike.plena = {-1, -1};
    sets[{alike.element, mesh.regions[element], alike}].push_back(element);
  }
  for (const auto& [key, elements] : sets) {
    const auto& [kind, region, place] = key;
    if (groups_.empty() || groups_.back().element != kind || groups_.back().region != region)
      groups_.push_back({kind, region, batch_count(), 0});
    for (const std::size_t element : elements) add_lane(mesh, element, place.normal);
    while (elements_.size() % width_ != 0) {
      add_lane(mesh, elements.back(), place.normal);
      edges_m_.back()[0] = 0.0;
    }
    const std::size_t count = (elements.size() + width_ - 1) / width_;
    normals_.insert(normals_.end(), count, static_cast<std::uint8_t>(place.normal));
    for (std::size_t lane = sides_.size(); lane < elements_.size(); ++lane) {
      plena_.push_back(places[elements_[lane]].plena);
      sides_.push_back(side_of(elements_[lane]));
    }
    groups_.back().batch_count += count;
  }
}

void ThinWallMesh::add_lane(const meshes::HexahedralMesh& mesh, std::size_t element, std::size_t normal) {
  const meshes::CornerPoints corners = meshes::corner_points(mesh, element);
  const std::optional<meshes::Point> edges = meshes::box_edges(corners);
  if (!edges)
    throw io::InputError("thin walls: element " + std::to_string(element) + " at " + meshes::millimetre_text(corners[0]) +
                         " is not a box along the axes");
  elements_.push_back(element);
  edges_m_.push_back({(*edges)[(normal + 1) % 3], (*edges)[(normal + 2) % 3], (*edges)[normal]});
  for (std::size_t c = 0; c < 8; ++c)
    first_components_.push_back(static_cast<std::uint32_t>(3 * mesh.elements[element][global_corner(normal, c)]));
}

std::array<double, shape_numbers_per_lane> ThinWallMesh::shape(std::size_t lane) const {
  if (!is_repeated(lane)) return shape_of(edges_m_[lane]);
  // The repeated element precedes the first repeated lane.
  std::size_t original = lane;
  while (is_repeated(original)) --original;
  std::array<double, shape_numbers_per_lane> result = shape_of(edges_m_[original]);
  result[3] = 0.0;
  return result;
}

ThinWallBranchLayout::ThinWallBranchLayout(const ThinWallMesh& walls) : walls_(walls) {
  for (const ThinWallGroup& group : walls.groups()) {
    positions_.push_back(number_count_);
    number_count_ += thin_wall_branch_numbers(group.element) * walls.width() * group.batch_count;
  }
}

std::size_t ThinWallBranchLayout::first(std::size_t group, std::size_t lane) const {
  const std::size_t width = walls_.width();
  const ThinWallGroup& its = walls_.groups()[group];
  return positions_[group] + thin_wall_branch_numbers(its.element) * width * (lane / width - its.first_batch) + lane % width;
}

}  // namespace menger::fem
