#include "fem/explicit/explicit_body.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "fem/explicit/three_field_elements.h"
#include "io/text/input_error.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::fem {
namespace {

void check(const meshes::HexahedralMesh& mesh, const ExplicitBodyOptions& options) {
  if (options.regions.size() != mesh.region_names.size())
    throw io::InputError("explicit dynamics: " + std::to_string(options.regions.size()) + " materials for " +
                         std::to_string(mesh.region_names.size()) + " regions");
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.regions[e] < mesh.region_names.size()) continue;
    throw io::InputError("explicit dynamics: element " + std::to_string(e) + ": has region " + std::to_string(mesh.regions[e]) +
                         " of " + std::to_string(mesh.region_names.size()));
  }
  for (std::size_t r = 0; r < options.regions.size(); ++r) {
    const ExplicitRegion& region = options.regions[r];
    const std::string name = "explicit dynamics: region \"" + mesh.region_names[r] + "\": ";
    if (!(region.density_kg_per_m3 > 0.0))
      throw io::InputError(name + "density_kg_per_m3 = " + std::to_string(region.density_kg_per_m3) + ": must be > 0");
    if (!(region.material.viscosity_Pa_s >= 0.0))
      throw io::InputError(name + "viscosity_Pa_s = " + std::to_string(region.material.viscosity_Pa_s) + ": must be >= 0");
    for (const MaxwellBranch& branch : region.material.branches) {
      if (!(branch.shear_modulus_Pa >= 0.0))
        throw io::InputError(name + "shear_modulus_Pa = " + std::to_string(branch.shear_modulus_Pa) +
                             " of the branch: must be >= 0");
      if (branch.is_there() && !(branch.relaxation_time_s > 0.0))
        throw io::InputError(name + "relaxation_time_s = " + std::to_string(branch.relaxation_time_s) + ": must be > 0");
    }
    if (acting(region.material.branches).size() > most_branches)
      throw io::InputError(name + std::to_string(region.material.branches.size()) + " branches: at most " +
                           std::to_string(most_branches));
  }
}

std::size_t nearest_point(const meshes::HexahedralMesh& mesh, const Point& position) {
  std::size_t nearest = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const double distance = norm(difference(mesh.points[p], position));
    if (distance < smallest) {
      smallest = distance;
      nearest = p;
    }
  }
  return nearest;
}

std::unique_ptr<ExplicitElements> elements_of(const meshes::HexahedralMesh& mesh, const ExplicitBodyOptions& options) {
  if (const auto* walls = std::get_if<ThinWallOptions>(&options.elements))
    return thin_wall_elements(mesh, options.regions, *walls);
  return std::make_unique<ThreeFieldElements>(mesh, options.regions, std::get<ThreeFieldOptions>(options.elements).kernels);
}

}  // namespace

ExplicitBody::ExplicitBody(const meshes::HexahedralMesh& mesh, const ExplicitBodyOptions& options) {
  check(mesh, options);
  elements_ = elements_of(mesh, options);
  regions_ = options.regions;
  for (const Point& point : mesh.points) positions_.insert(positions_.end(), point.begin(), point.end());
  add_masses(mesh);
  hold(mesh, options);
}

/// Adds up masses, stiffness and the smallest edge of the elements, which are boxes.
void ExplicitBody::add_masses(const meshes::HexahedralMesh& mesh) {
  masses_.assign(mesh.points.size(), 0.0);
  smallest_edge_m_ = std::numeric_limits<double>::infinity();
  for (std::size_t element = 0; element < mesh.elements.size(); ++element) {
    const meshes::CornerPoints corners = meshes::corner_points(mesh, element);
    const Point edges = difference(corners[7], corners[0]);
    const double volume = edges[0] * edges[1] * edges[2];
    const ExplicitRegion& region = regions_[mesh.regions[element]];
    for (const std::size_t node : mesh.elements[element]) masses_[node] += 0.125 * region.density_kg_per_m3 * volume;
    stiffness_J_ += materials::shear_modulus_at_rest_Pa(region.material.law) * volume;
    smallest_edge_m_ = std::min({smallest_edge_m_, edges[0], edges[1], edges[2]});
  }
  for (std::size_t node = 0; node < masses_.size(); ++node) {
    if (!(masses_[node] > 0.0))
      throw io::InputError("explicit dynamics: node " + std::to_string(node) + " at " +
                           meshes::millimetre_text(mesh.points[node]) + " belongs to no element");
    inverse_masses_.insert(inverse_masses_.end(), 3, 1.0 / masses_[node]);
  }
}

void ExplicitBody::hold(const meshes::HexahedralMesh& mesh, const ExplicitBodyOptions& options) {
  for (const Support& support : options.supports) {
    for (const meshes::BoundaryFace& face : mesh.faces) {
      if (face.label != support.label) continue;
      for (const std::size_t node : face.corners) hold_node(node, support.held);
    }
  }
  for (const PointSupport& support : options.point_supports) hold_node(nearest_point(mesh, support.position), support.held);
}

void ExplicitBody::hold_node(std::size_t node, const std::array<bool, 3>& held) {
  for (std::size_t i = 0; i < 3; ++i)
    if (held[i]) inverse_masses_[3 * node + i] = 0.0;
}

double ExplicitBody::mass_kg() const { return std::accumulate(masses_.begin(), masses_.end(), 0.0); }

double ExplicitBody::smallest_density_kg_per_m3() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ExplicitRegion& region : regions_) smallest = std::min(smallest, region.density_kg_per_m3);
  return smallest;
}

bool ExplicitBody::is_viscous() const {
  return std::any_of(regions_.begin(), regions_.end(),
                     [](const ExplicitRegion& region) { return region.material.viscosity_Pa_s > 0.0; });
}

std::optional<double> ExplicitBody::shortest_relaxation_time_s() const {
  std::optional<double> shortest;
  for (const ExplicitRegion& region : regions_) {
    for (const MaxwellBranch& branch : acting(region.material.branches))
      shortest = std::min(shortest.value_or(branch.relaxation_time_s), branch.relaxation_time_s);
  }
  return shortest;
}

}  // namespace menger::fem
