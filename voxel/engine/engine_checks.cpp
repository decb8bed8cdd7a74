// Which voxel or beam a run diverged at: asked only when a sweep saw something out of range.

#include <algorithm>
#include <cmath>

#include "voxel/engine/engine.h"

namespace menger::voxel {

/// Of the beams as they are in this step, before sizes and positions move on.
template <class Real>
void EngineOf<Real>::note_strain() {
  Divergence found{.voxel = 0, .cell = {}, .quantity = "strain", .value = 0.0, .limit = physics.limits.strain, .time_s = 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice->beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const double strain = static_cast<double>(state_->data.axis[axis].history[i]) / rest_length(axis, i);
      if (std::abs(strain) <= std::abs(*found.value)) continue;
      found.voxel = static_cast<std::size_t>(beams.lower[i]);
      if (!std::isfinite(strain)) {
        found.quantity = "not finite";
        found.value.reset();
        found.cell = cell_of(found.voxel);
        divergence = found;
        return;
      }
      found.value = strain;
    }
  }
  found.cell = cell_of(found.voxel);
  divergence = found;
}

/// Of the beams as they are in this step, against the strains that the parameters were fitted on.
template <class Real>
void EngineOf<Real>::check_validity() {
  pressures_->note_strains(state_->data);
  strain_range = pressures_->strains();
  const CalibratedBody& body = *physics.surrogate;
  const ValidityRange& validity = body.parameters.validity;
  if (divergence || body.outside_range == OutsideRange::warn) return;
  const bool too_small = strain_range->smallest < validity.smallest_strain;
  if (!too_small && strain_range->largest <= validity.largest_strain) return;
  const double value = too_small ? strain_range->smallest : strain_range->largest;
  divergence = Divergence{.voxel = 0,
                          .cell = {},
                          .quantity = "strain outside the range of validity",
                          .value = value,
                          .limit = too_small ? validity.smallest_strain : validity.largest_strain,
                          .time_s = 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice->beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const double strain = static_cast<double>(state_->data.axis[axis].history[i] / state_->data.axis[axis].rest_length[i]);
      if (strain == value) divergence->voxel = static_cast<std::size_t>(beams.lower[i]);
    }
  }
  divergence->cell = cell_of(divergence->voxel);
}

template <class Real>
void EngineOf<Real>::note_speed() {
  Divergence found{.voxel = 0, .cell = {}, .quantity = "speed", .value = 0.0, .limit = speed_limit_m_s_, .time_s = 0.0};
  for (std::size_t i = 0; i < lattice->voxel_count(); ++i) {
    const VoxelView voxel = view(i);
    const double speed = std::hypot(voxel.velocity_m_s[0], voxel.velocity_m_s[1], voxel.velocity_m_s[2]);
    if (speed <= *found.value) continue;
    found.voxel = i;
    found.value = speed;
    if (std::isfinite(speed)) continue;
    found.quantity = "not finite";
    found.value.reset();
    break;
  }
  found.cell = cell_of(found.voxel);
  divergence = found;
}

template void EngineOf<double>::note_strain();
template void EngineOf<float>::note_strain();
template void EngineOf<double>::check_validity();
template void EngineOf<float>::check_validity();
template void EngineOf<double>::note_speed();
template void EngineOf<float>::note_speed();

}  // namespace menger::voxel
