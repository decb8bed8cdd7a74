#include "fem/implicit/implicit_contact.h"

#include <algorithm>
#include <cmath>

#include "fem/space/face_area.h"

namespace menger::fem {
namespace {

using Plane = std::array<double, 2>;

Plane in_plane(std::span<const double> field, std::size_t node) { return {field[3 * node], field[3 * node + 1]}; }

double length(const Plane& a) { return std::hypot(a[0], a[1]); }

/// Returns the area of each node of this rank on the faces that bound no chamber.
std::vector<double> outer_areas_m2(const Assembly& assembly, const Body& body) {
  const Space& space = assembly.space();
  std::vector<bool> is_inside;
  for (const ChamberSurface& surface : body.chambers) {
    for (const std::size_t label : surface.labels) {
      if (is_inside.size() <= label) is_inside.resize(label + 1, false);
      is_inside[label] = true;
    }
  }
  std::vector<double> areas(3 * space.positions.size(), 0.0);
  for (const SpaceFace& face : space.faces) {
    if (face.label < is_inside.size() && is_inside[face.label]) continue;
    const std::vector<double> shares = nodal_areas_m2(space, face);
    for (std::size_t a = 0; a < shares.size(); ++a) areas[3 * static_cast<std::size_t>(face.nodes[a])] += shares[a];
  }
  assembly.exchange().add_from_ghosts(areas);
  std::vector<double> per_node(static_cast<std::size_t>(space.owned_count));
  for (std::size_t node = 0; node < per_node.size(); ++node) per_node[node] = areas[3 * node];
  return per_node;
}

/// Returns part (I - n n^T) for a unit vector n.
std::array<double, 4> across(double part, const Plane& n) {
  return {part * (1.0 - n[0] * n[0]), -part * n[0] * n[1], -part * n[0] * n[1], part * (1.0 - n[1] * n[1])};
}

}  // namespace

ImplicitContact::ImplicitContact(const Assembly& assembly, const Body& body, const RigidGround& ground, double stick_stiffness)
    : assembly_(assembly), ground_(ground), stick_stiffness_(stick_stiffness) {
  const std::vector<double> areas = outer_areas_m2(assembly, body);
  for (std::size_t node = 0; node < areas.size(); ++node) {
    if (areas[node] == 0.0) continue;
    const bool has_friction = assembly.held()[3 * node] == 0 && assembly.held()[3 * node + 1] == 0;
    springs_.push_back({static_cast<Index>(node), ground.stiffness_Pa_per_m * areas[node], has_friction});
    largest_stick_stiffness_ = std::max(largest_stick_stiffness_, stick_stiffness_ * springs_.back().stiffness_N_per_m);
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest_stick_stiffness_, 1, MPI_DOUBLE, MPI_MAX, assembly.space().communicator);
}

void ImplicitContact::stick_or_slip(const Spring& spring, const StepMotion& motion, const GroundNode& before,
                                    Response& response) const {
  const Plane start = in_plane(motion.start_displacements_m, static_cast<std::size_t>(spring.node));
  const Plane end = in_plane(motion.displacements_m, static_cast<std::size_t>(spring.node));
  GroundNode& node = response.node;
  node.anchor_m = before.touches ? before.anchor_m : start;
  const double stiffness = stick_stiffness_ * spring.stiffness_N_per_m;
  const Plane pulled{end[0] - node.anchor_m[0], end[1] - node.anchor_m[1]};
  const double distance = length(pulled);
  const Friction& friction = ground_.friction;
  const double scale = directional_factor(friction, pulled) * response.normal_N;
  const bool stuck = before.touches && !before.slides;
  const double limit = (stuck ? friction.static_coefficient : friction.kinetic_coefficient) * scale;
  if (limit <= 0.0) {
    node.slides = true;
    node.anchor_m = end;
    return;
  }
  if (stiffness * distance <= limit) {
    node.friction_N = {-stiffness * pulled[0], -stiffness * pulled[1]};
    const Plane velocity = in_plane(motion.velocities_m_per_s, static_cast<std::size_t>(spring.node));
    node.slides = !stuck && velocity[0] * pulled[0] + velocity[1] * pulled[1] > 0.0;
    response.tangent = {stiffness, 0.0, 0.0, stiffness};
    return;
  }
  const double force = limit;
  const Plane direction{pulled[0] / distance, pulled[1] / distance};
  node.slides = true;
  node.friction_N = {-force * direction[0], -force * direction[1]};
  for (std::size_t i = 0; i < 2; ++i) node.anchor_m[i] = end[i] + node.friction_N[i] / stiffness;
  response.tangent = across(force / distance, direction);
}

void ImplicitContact::follow_speed(const Plane& velocity, double velocity_by_displacement, Response& response) const {
  const Friction& friction = ground_.friction;
  const double speed = length(velocity);
  const double scale = directional_factor(friction, velocity) * response.normal_N;
  const double limit = friction.regularisation_speed_m_per_s;
  response.node.slides = speed > limit;
  const double by_speed = response.node.slides ? friction.kinetic_coefficient * scale / speed  //
                                               : friction.static_coefficient * scale / limit;
  response.node.friction_N = {-by_speed * velocity[0], -by_speed * velocity[1]};
  const double by_displacement = by_speed * velocity_by_displacement;
  response.tangent = response.node.slides ? across(by_displacement, {velocity[0] / speed, velocity[1] / speed})
                                          : std::array<double, 4>{by_displacement, 0.0, 0.0, by_displacement};
}

ImplicitContact::Response ImplicitContact::response_of(const Spring& spring, const StepMotion& motion,
                                                       const GroundNode& before) const {
  Response response;
  const auto node = static_cast<std::size_t>(spring.node);
  const double height = assembly_.space().positions[node][2] + motion.displacements_m[3 * node + 2];
  const double depth = ground_.height_m - height;
  if (!(depth > 0.0)) return response;
  response.normal_N = spring.stiffness_N_per_m * depth;
  response.node.touches = true;
  if (!spring.has_friction) return response;
  if (ground_.friction.regularisation_speed_m_per_s > 0.0) {
    follow_speed(in_plane(motion.velocities_m_per_s, node), motion.velocity_by_displacement_per_s, response);
  } else {
    stick_or_slip(spring, motion, before, response);
  }
  return response;
}

/// Returns the energy lost to friction in the step: the work against friction minus the energy stored in the stick spring. The
/// energy of the stick spring of a node that has left the ground is lost, too.
double ImplicitContact::loss_of(const Spring& spring, const StepMotion& motion, const GroundNode& before,
                                const GroundNode& after) const {
  const auto node = static_cast<std::size_t>(spring.node);
  const bool by_speed = ground_.friction.regularisation_speed_m_per_s > 0.0;
  const Plane start = in_plane(motion.start_displacements_m, node);
  const Plane end = in_plane(motion.displacements_m, node);
  if (!after.touches) {
    if (by_speed || !before.touches) return 0.0;
    const double force = length(before.friction_N);
    return 0.5 * force * force / (stick_stiffness_ * spring.stiffness_N_per_m);
  }
  double loss = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double moved = by_speed ? end[i] - start[i] : after.anchor_m[i] - (before.touches ? before.anchor_m[i] : start[i]);
    loss -= 0.5 * (before.friction_N[i] + after.friction_N[i]) * moved;
  }
  return loss;
}

GroundTotals ImplicitContact::add_forces(const StepMotion& motion, std::span<const GroundNode> before,
                                         std::span<GroundNode> after, std::span<double> residual_N) const {
  GroundTotals totals;
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Spring& spring = springs_[s];
    const Response response = response_of(spring, motion, before[s]);
    after[s] = response.node;
    if (spring.has_friction) totals.friction_loss_J += loss_of(spring, motion, before[s], after[s]);
    push(spring, response.normal_N, after[s], residual_N, totals);
  }
  return totals;
}

GroundTotals ImplicitContact::add_remembered_forces(std::span<const double> displacements_m, std::span<const GroundNode> nodes,
                                                    std::span<double> residual_N) const {
  GroundTotals totals;
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const auto node = static_cast<std::size_t>(springs_[s].node);
    const double depth = ground_.height_m - assembly_.space().positions[node][2] - displacements_m[3 * node + 2];
    push(springs_[s], springs_[s].stiffness_N_per_m * std::max(depth, 0.0), nodes[s], residual_N, totals);
  }
  return totals;
}

/// Subtracts the ground's forces on a node that touches it from the residual, and adds to the totals.
void ImplicitContact::push(const Spring& spring, double normal_N, const GroundNode& node, std::span<double> residual_N,
                           GroundTotals& totals) const {
  if (!node.touches) return;
  const auto first = 3 * static_cast<std::size_t>(spring.node);
  for (std::size_t i = 0; i < 2; ++i) residual_N[first + i] -= node.friction_N[i];
  if (assembly_.held()[first + 2] == 0) residual_N[first + 2] -= normal_N;
  totals.force_N += normal_N;
  totals.normal_energy_J += 0.5 * normal_N * normal_N / spring.stiffness_N_per_m;
  if (ground_.friction.regularisation_speed_m_per_s > 0.0) return;
  const double force = length(node.friction_N);
  totals.stick_energy_J += 0.5 * force * force / (stick_stiffness_ * spring.stiffness_N_per_m);
}

double ImplicitContact::unbalanced_N(std::span<const GroundNode> nodes, std::span<const double> residual_N) const {
  double left = 0.0;
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    if (nodes[s].touches && springs_[s].has_friction)
      left += length(in_plane(residual_N, static_cast<std::size_t>(springs_[s].node)));
  }
  return left;
}

void ImplicitContact::add_matrix(const StepMotion& motion, std::span<const GroundNode> before, Mat matrix) const {
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Response response = response_of(springs_[s], motion, before[s]);
    if (!response.node.touches) continue;
    const auto& t = response.tangent;
    std::array<double, 9> block{t[0], t[1], 0.0, t[2], t[3], 0.0, 0.0, 0.0, springs_[s].stiffness_N_per_m};
    assembly_.add_to_matrix(matrix, std::span(&springs_[s].node, 1), block);
  }
}

}  // namespace menger::fem
