#include "fem/explicit/explicit_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

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
    const MaxwellBranch& branch = region.material.branch;
    if (!(branch.shear_modulus_Pa >= 0.0))
      throw io::InputError(name + "shear_modulus_Pa = " + std::to_string(branch.shear_modulus_Pa) +
                           " of the branch: must be >= 0");
    if (branch.is_there() && !(branch.relaxation_time_s > 0.0))
      throw io::InputError(name + "relaxation_time_s = " + std::to_string(branch.relaxation_time_s) + ": must be > 0");
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

}  // namespace

ExplicitBody::ExplicitBody(const meshes::HexahedralMesh& mesh, ExplicitBodyOptions options, const ExplicitKernels& kernels)
    : kernels_(kernels), boxes_(mesh, kernels.width), masses_(mesh.points.size(), 0.0) {
  check(mesh, options);
  for (const meshes::Point& point : mesh.points) positions_.insert(positions_.end(), point.begin(), point.end());
  for (const BoxGroup& group : boxes_.groups()) {
    const double density = options.regions[group.region].density_kg_per_m3;
    for (std::size_t lane = group.first_batch * boxes_.width(); lane < (group.first_batch + group.batch_count) * boxes_.width();
         ++lane) {
      for (const std::uint32_t component : boxes_.first_components(lane))
        masses_[component / 3] += 0.125 * density * boxes_.volume_m3(lane);
    }
  }
  for (std::size_t node = 0; node < masses_.size(); ++node) {
    if (!(masses_[node] > 0.0))
      throw io::InputError("explicit dynamics: node " + std::to_string(node) + " at " +
                           meshes::millimetre_text(mesh.points[node]) + " belongs to no element");
    inverse_masses_.insert(inverse_masses_.end(), 3, 1.0 / masses_[node]);
  }
  hold(mesh, options);
  regions_ = std::move(options.regions);
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

double ExplicitBody::stiffness_J() const {
  double stiffness = 0.0;
  for (const BoxGroup& group : boxes_.groups()) {
    const double shear_modulus = materials::shear_modulus_at_rest_Pa(regions_[group.region].material.law);
    for (std::size_t lane = group.first_batch * boxes_.width(); lane < (group.first_batch + group.batch_count) * boxes_.width();
         ++lane)
      stiffness += shear_modulus * boxes_.volume_m3(lane);
  }
  return stiffness;
}

std::optional<double> ExplicitBody::shortest_relaxation_time_s() const {
  std::optional<double> shortest;
  for (const BoxGroup& group : boxes_.groups()) {
    const MaxwellBranch& branch = regions_[group.region].material.branch;
    if (branch.is_there()) shortest = std::min(shortest.value_or(branch.relaxation_time_s), branch.relaxation_time_s);
  }
  return shortest;
}

AlignedNumbers ExplicitBody::branches_at_rest(std::span<const double> displacements_m) const {
  if (!shortest_relaxation_time_s()) return {};
  const std::size_t width = boxes_.width();
  AlignedNumbers tensors(branch_position(boxes_.batch_count()), 0.0);
  for (std::size_t n = 0; n < tensors.size(); ++n)
    if (n / width % 6 < 3) tensors[n] = 1.0;  // any positive tensor will do: it relaxes completely
  AlignedNumbers slots(24 * width * boxes_.batch_count());
  element_forces({displacements_m.data()}, 0, boxes_.batch_count(), slots.data(),
                 {tensors.data(), std::numeric_limits<double>::infinity()});
  return tensors;
}

ElementsOutcome ExplicitBody::element_forces(const NodalMotion& motion, std::size_t first_batch, std::size_t batch_count,
                                             double* slots_N, const BranchTensors& branch) const {
  ElementsOutcome outcome;
  for (const BoxGroup& group : boxes_.groups()) {
    const std::size_t first = std::max(first_batch, group.first_batch);
    const std::size_t end = std::min(first_batch + batch_count, group.first_batch + group.batch_count);
    if (first >= end) continue;
    BranchTensors own = branch;
    if (own.values != nullptr) own.values += branch_position(first);
    const ElementsOutcome part = kernels_.forces(regions_[group.region].material, boxes_.batches(first, end - first), motion, own,
                                                 slots_N + 24 * boxes_.width() * first);
    outcome.smallest_ratio = std::min(outcome.smallest_ratio, part.smallest_ratio);
    outcome.dissipated_W += part.dissipated_W;
    outcome.relaxed_J += part.relaxed_J;
  }
  return outcome;
}

ExplicitBody::ElementEnergies ExplicitBody::element_energies(std::span<const double> displacements_m,
                                                             std::span<const double> branch) const {
  ElementEnergies result;
  result.energies_J.resize(boxes_.batch_count() * boxes_.width());
  result.smallest_ratios.resize(result.energies_J.size());
  for (const BoxGroup& group : boxes_.groups()) {
    const std::size_t first = group.first_batch * boxes_.width();
    kernels_.energies(regions_[group.region].material, boxes_.batches(group.first_batch, group.batch_count),
                      {displacements_m.data()}, branch.empty() ? nullptr : branch.data() + branch_position(group.first_batch),
                      result.energies_J.data() + first, result.smallest_ratios.data() + first);
  }
  return result;
}

double ExplicitBody::strain_energy_J(std::span<const double> displacements_m, std::span<const double> branch) const {
  const ElementEnergies elements = element_energies(displacements_m, branch);
  return std::accumulate(elements.energies_J.begin(), elements.energies_J.end(), 0.0);
}

std::optional<FailedElement> ExplicitBody::failed_element(std::span<const double> displacements_m) const {
  const AlignedNumbers ratios = element_energies(displacements_m, {}).smallest_ratios;
  for (std::size_t lane = 0; lane < ratios.size(); ++lane) {
    if (ratios[lane] > 0.0) continue;
    FailedElement failed{boxes_.element(lane), {}, true};
    for (const std::uint32_t component : boxes_.first_components(lane))
      for (std::size_t i = 0; i < 3; ++i) failed.is_finite = failed.is_finite && std::isfinite(displacements_m[component + i]);
    for (std::size_t i = 0; i < 3; ++i) failed.position_m[i] = positions_[boxes_.first_components(lane)[0] + i];
    return failed;
  }
  return std::nullopt;
}

}  // namespace menger::fem
