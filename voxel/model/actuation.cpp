#include "voxel/model/actuation.h"

#include <algorithm>

namespace menger::voxel {

std::vector<double> actuation_phases(const Lattice& lattice, const Actuation& actuation) {
  std::vector<double> phases(lattice.voxel_count(), 0.0);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    if (actuation.mode == ActuationMode::antiphase) {
      phases[i] = actuation.material_phase[static_cast<std::size_t>(lattice.material[i] - 1)];
    } else if (actuation.mode == ActuationMode::wave) {
      const meshes::CellIndex& cell = lattice.cells[i];
      const int position = actuation.wave_axis == 0 ? cell.x : actuation.wave_axis == 1 ? cell.y : cell.z;
      const int width = lattice.grid[static_cast<std::size_t>(actuation.wave_axis)];
      const int length = actuation.wave_over_gaps ? std::max(width - 1, 1) : width;
      phases[i] = actuation.wave_periods_per_body * static_cast<double>(position) / static_cast<double>(length);
    }
  }
  return phases;
}

DriveMoment drive_moment(const Actuation& actuation, double time_s) {
  DriveMoment moment;
  if (time_s < actuation.ramp_s) {
    moment.ramp = time_s / actuation.ramp_s;
    moment.ramp_rate = 1.0 / actuation.ramp_s;
  }
  if (actuation.mode == ActuationMode::none) {
    moment.sine = moment.cosine = 0.0;
  } else if (actuation.mode == ActuationMode::hold) {
    moment.sine = moment.ramp;
    moment.cosine = 0.0;
    moment.sine_rate = moment.ramp_rate;
  } else {
    const DriveAngle angle = drive_angle(time_s, actuation.period_s());
    const double frequency = 2.0 * std::numbers::pi / actuation.period_s();
    moment.sine = moment.ramp * angle.sine;
    moment.cosine = moment.ramp * angle.cosine;
    moment.sine_rate = frequency * moment.cosine + moment.ramp_rate * angle.sine;
    moment.cosine_rate = -frequency * moment.sine + moment.ramp_rate * angle.cosine;
  }
  return moment;
}

}  // namespace menger::voxel
