// What an engine shows of its state.

#include <array>
#include <cmath>

#include "voxel/engine/engine.h"

namespace menger::voxel {

namespace {

constexpr auto line_size = static_cast<std::size_t>(line_length);

}  // namespace

meshes::CellIndex Simulation::Engine::cell_of(std::size_t voxel) const {
  const meshes::CellIndex& place = lattice->cells[voxel];
  const int parts = physics.surrogate ? physics.surrogate->parameters.voxels_per_cell : 1;
  return {place.x / parts, place.y / parts, place.z / parts};
}

template <class Real>
double EngineOf<Real>::rest_length(std::size_t axis, std::size_t beam) const {
  return static_cast<double>(rest_length_m(state_->data, axis, beam));
}

template <class Real>
Simulation::Engine::VoxelView EngineOf<Real>::view(std::size_t voxel) const {
  const Real* pose = state_->data.pose + line_size * voxel;
  const Real* motion = state_->data.motion + line_size * voxel;
  const Real* coefficients = state_->data.voxel_table + line_size * static_cast<std::size_t>(state_->data.voxel_class[voxel]);
  const auto inverse_mass = static_cast<double>(coefficients[class_slot::inverse_mass]);
  const auto inverse_inertia = static_cast<double>(coefficients[class_slot::inverse_inertia]);
  const auto number = [](Real value) { return static_cast<double>(value); };
  VoxelView v{};
  v.position_m = state_->position_m(voxel);
  v.velocity_m_s = {inverse_mass * number(motion[slot::px]), inverse_mass * number(motion[slot::py]),
                    inverse_mass * number(motion[slot::pz])};
  v.angular_velocity_rad_s = {inverse_inertia * number(motion[slot::hx]), inverse_inertia * number(motion[slot::hy]),
                              inverse_inertia * number(motion[slot::hz])};
  v.orientation = {number(pose[slot::qw]), number(pose[slot::qx]), number(pose[slot::qy]), number(pose[slot::qz])};
  v.size_m = number(pose[slot::size]);
  v.reach_m.fill(0.5 * v.size_m);
  if (pressures_) v.reach_m = pressures_->reach_m(voxel);
  const bool on_feet = feet_ && steps > 0;  // which have not been asked for before
  v.is_static = on_feet ? feet_->sticks(voxel) : motion[slot::is_static] > Real(0.5);
  v.touches_floor =
      on_feet ? feet_->touches(voxel) : physics.floor && 0.5 * v.size_m - 0.5 * cell_edge_m - v.position_m[2] >= 0.0;
  return v;
}

template <class Real>
std::vector<double> EngineOf<Real>::strains() const {
  std::vector<double> largest(lattice->voxel_count(), 0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice->beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const auto lower = static_cast<std::size_t>(beams.lower[i]);
      const auto upper = static_cast<std::size_t>(beams.upper[i]);
      const std::array<double, 3> from = view(lower).position_m;
      const std::array<double, 3> to = view(upper).position_m;
      const double strain = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) / rest_length(axis, i) - 1.0;
      for (const std::size_t end : {lower, upper}) {
        if (std::abs(strain) > std::abs(largest[end])) largest[end] = strain;
      }
    }
  }
  return largest;
}

template <class Real>
std::size_t EngineOf<Real>::large_angle_beams() const {
  std::size_t count = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = state_->data.axis[axis];
    const Real* small = beams.history + (history_values - 1) * beams.count;
    for (std::size_t i = 0; i < lattice->beams[axis].lower.size(); ++i) count += small[i] < Real(0.5) ? 1 : 0;
  }
  return count;
}

template <class Real>
std::vector<bool> EngineOf<Real>::in_contact_with_others() const {
  std::vector<bool> touching(lattice->voxel_count(), false);
  if (!close_pairs_) return touching;
  for (const auto& [first, second] : close_pairs_->pairs()) {
    const VoxelView a = view(static_cast<std::size_t>(first));
    const VoxelView b = view(static_cast<std::size_t>(second));
    const double distance =
        std::hypot(a.position_m[0] - b.position_m[0], a.position_m[1] - b.position_m[1], a.position_m[2] - b.position_m[2]);
    const StepData<Real>& d = state_->data;
    const double sizes = static_cast<double>(size_m(d, static_cast<std::size_t>(first))) +
                         static_cast<double>(size_m(d, static_cast<std::size_t>(second)));
    if (distance >= collision_radius_fraction * sizes) continue;
    touching[static_cast<std::size_t>(first)] = true;
    touching[static_cast<std::size_t>(second)] = true;
  }
  return touching;
}

template <class Real>
std::vector<std::string> EngineOf<Real>::kernel_report() const {
  return report_;
}

template double EngineOf<double>::rest_length(std::size_t, std::size_t) const;
template double EngineOf<float>::rest_length(std::size_t, std::size_t) const;
template Simulation::Engine::VoxelView EngineOf<double>::view(std::size_t) const;
template Simulation::Engine::VoxelView EngineOf<float>::view(std::size_t) const;
template std::vector<double> EngineOf<double>::strains() const;
template std::vector<double> EngineOf<float>::strains() const;
template std::size_t EngineOf<double>::large_angle_beams() const;
template std::size_t EngineOf<float>::large_angle_beams() const;
template std::vector<bool> EngineOf<double>::in_contact_with_others() const;
template std::vector<bool> EngineOf<float>::in_contact_with_others() const;
template std::vector<std::string> EngineOf<double>::kernel_report() const;
template std::vector<std::string> EngineOf<float>::kernel_report() const;

}  // namespace menger::voxel
