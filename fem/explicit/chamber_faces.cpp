#include "fem/explicit/chamber_faces.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace menger::fem {

std::vector<meshes::BoundaryFace> faces_of_chamber(const meshes::HexahedralMesh& mesh, std::size_t chamber) {
  const std::vector<std::size_t>& labels = mesh.chambers[chamber].labels;
  std::vector<meshes::BoundaryFace> faces;
  for (const meshes::BoundaryFace& face : mesh.faces)
    if (std::find(labels.begin(), labels.end(), face.label) != labels.end()) faces.push_back(face);
  return faces;
}

template <class Number>
ChamberFaces<Number>::ChamberFaces(const meshes::HexahedralMesh& mesh, FaceValues values,
                                   const FacePressureKernels<Number>& kernels, const std::set<meshes::FaceCorners>& left_out)
    : kernels_(kernels) {
  const std::size_t width = kernels_.width;
  std::vector<std::array<Number, half_edge_numbers_per_face>> edges;  // per lane
  for (std::size_t chamber = 0; chamber < mesh.chambers.size(); ++chamber) {
    for (const meshes::BoundaryFace& face : faces_of_chamber(mesh, chamber)) {
      if (left_out.contains(meshes::sorted(face.corners))) continue;
      for (const std::size_t corner : face.corners) first_components_.push_back(static_cast<std::uint32_t>(3 * corner));
      has_face_.push_back(true);
      const auto at = [&](std::size_t corner) -> const meshes::Point& { return mesh.points[face.corners[corner]]; };
      edges.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        edges.back()[i] = static_cast<Number>(0.5 * (at(1)[i] - at(0)[i]));
        edges.back()[3 + i] = static_cast<Number>(0.5 * (at(3)[i] - at(0)[i]));
      }
    }
    while (has_face_.size() % width != 0) {
      first_components_.resize(first_components_.size() + 4, first_components_.back());
      has_face_.push_back(false);
      edges.push_back({});
    }
    chambers_.resize(has_face_.size() / width, chamber);
  }
  if (values == FaceValues::positions) return;
  half_edges_m_.resize(half_edge_numbers_per_face * edges.size());
  for (std::size_t lane = 0; lane < edges.size(); ++lane)
    for (std::size_t n = 0; n < half_edge_numbers_per_face; ++n)
      half_edges_m_[(lane / width * half_edge_numbers_per_face + n) * width + lane % width] = edges[lane][n];
}

template <class Number>
void ChamberFaces<Number>::add_slots(std::uint32_t first_slot, std::vector<std::uint32_t>& nodes,
                                     std::vector<std::uint32_t>& slots) const {
  for (std::size_t lane = 0; lane < has_face_.size(); ++lane) {
    if (!has_face_[lane]) continue;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      nodes.push_back(first_components_[4 * lane + corner] / 3);
      slots.push_back(first_slot + static_cast<std::uint32_t>(kernels_.slot(lane, corner)));
    }
  }
}

template <class Number>
void ChamberFaces<Number>::compute(IndexRange batches, const Number* values_m, std::span<const double> pressures_Pa,
                                   Number* slots_N, double* volumes_m3) const {
  const std::size_t width = kernels_.width;
  FaceBatches<Number> part;
  for (std::size_t first = batches.begin; first < batches.end; first += part.count) {
    part.count = 1;
    while (first + part.count < batches.end && chambers_[first + part.count] == chambers_[first]) ++part.count;
    part.first_components = first_components_.data() + 4 * width * first;
    if (!half_edges_m_.empty()) part.half_edges_m = half_edges_m_.data() + half_edge_numbers_per_face * width * first;
    part.pressure_Pa = pressures_Pa[chambers_[first]];
    if (volumes_m3 != nullptr) part.volumes_m3 = volumes_m3 + first;
    kernels_.forces(part, values_m, slots_N + slot_numbers_per_face * width * first);
  }
}

template class ChamberFaces<double>;
template class ChamberFaces<float>;

bool has_closed_plena(const meshes::HexahedralMesh& mesh) {
  // Of each edge: how often it is run along in one direction minus how often in the other.
  std::map<std::tuple<std::size_t, std::size_t, std::size_t>, int> turns;
  for (std::size_t chamber = 0; chamber < mesh.chambers.size(); ++chamber) {
    for (const meshes::BoundaryFace& face : faces_of_chamber(mesh, chamber)) {
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t from = face.corners[c];
        const std::size_t to = face.corners[(c + 1) % 4];
        turns[{mesh.chambers[chamber].plenum, std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
      }
    }
  }
  return std::all_of(turns.begin(), turns.end(), [](const auto& edge) { return edge.second == 0; });
}

}  // namespace menger::fem
