#include <cassert>
#include <cmath>
#include <numbers>

#include "fem/pneumatics/pneumatic_supply.h"

namespace menger::fem {
namespace {

// Alexander's rule: both stages are steps of gamma, the first ends after gamma, the second begins from what the first says of
// the rate: N + (1 - gamma) step rate.
const double gamma_of_stages = 1.0 - 0.5 * std::numbers::sqrt2;

double mean(double a, double b) { return 0.5 * (a + b); }

}  // namespace

bool PneumaticSupply::advance(PneumaticState& state, double time_s, std::span<const double> volumes_m3) const {
  assert(volumes_m3.size() == plena_.size());
  for (const double volume : volumes_m3)
    if (!(volume > 0.0) || !std::isfinite(volume)) return false;
  return advance(state, time_s, Walls{.volumes_m3 = volumes_m3});
}

bool PneumaticSupply::advance(PneumaticState& state, double time_s, std::span<const PlenumCompliance> plena) const {
  assert(plena.size() == plena_.size());
  return advance(state, time_s, Walls{.compliances = plena});
}

bool PneumaticSupply::advance(PneumaticState& state, double time_s, const Walls& walls) const {
  assert(time_s > state.time_s);
  PneumaticState end = state;
  end.time_s = time_s;
  for (std::size_t j = 0; j < plena_.size(); ++j) {
    if (!walls.volumes_m3.empty())
      end.volumes_m3[j] = walls.volumes_m3[j];
    else if (!has_line(j))
      end.volumes_m3[j] = walls.compliances[j].volume_m3(pressure_Pa(end, j));
  }
  for (const Group& group : groups_) {
    const std::optional<Manifold> manifold = flow(state, group, time_s, walls);
    if (!manifold || !settle(state, group, *manifold, time_s, end)) return false;
  }
  state = std::move(end);
  return true;
}

/// Volumes and source pressure at a part of the step; the time is that of the stage.
void PneumaticSupply::set_stage(const PneumaticState& state, const Group& group, const Walls& walls, double part, double time_s,
                                Manifold& manifold) const {
  if (group.piston)
    manifold.volume_m3 = root_volume_m3(group, time_s);
  else
    manifold.source_pressure_Pa = fem::pressure_Pa(std::get<LineSupply>(plena_[group.plena.front()]).source, time_s);
  for (std::size_t i = 0; i < group.plena.size(); ++i) {
    const std::size_t j = group.plena[i];
    LineEnd& end = manifold.ends[i];
    end.volume_m3 = 0.5 * line(j)->volume_m3;
    if (walls.compliances.empty())
      end.volume_m3 += std::lerp(state.volumes_m3[j], walls.volumes_m3[j], part);
    else
      end.plenum = &walls.compliances[j];
  }
}

/// The manifold at the end of the step: pressures, and the air that each volume has at them.
std::optional<Manifold> PneumaticSupply::flow(const PneumaticState& state, const Group& group, double time_s,
                                              const Walls& walls) const {
  const double step = time_s - state.time_s;
  const double gamma = gamma_of_stages;
  Manifold manifold;
  manifold.pressure_Pa = root_pressure_Pa(state, group);
  if (group.piston) manifold.free_air_m3 = state.piston_air_m3[*group.piston];
  for (const std::size_t j : group.plena) {
    manifold.ends.push_back({.resistance_Pa_s_per_m3 = line(j)->resistance_Pa_s_per_m3,
                             .laminar_drive_Pa = laminar_drive_Pa(gas_, *line(j)),
                             .free_air_m3 = state.plenum_air_m3[j],
                             .pressure_Pa = pressure_Pa(state, j)});
  }
  set_stage(state, group, walls, gamma, state.time_s + gamma * step, manifold);
  if (!relax(gas_, gamma * step, manifold)) return std::nullopt;
  for (LineEnd& end : manifold.ends) {
    const double air = fem::free_air_m3(gas_, end.pressure_Pa, end.volume_at_m3(end.pressure_Pa));
    const double carried = (1.0 - gamma) / gamma * (air - end.free_air_m3);
    end.free_air_m3 += carried;
    manifold.free_air_m3 -= carried;
  }
  set_stage(state, group, walls, 1.0, time_s, manifold);
  if (!relax(gas_, gamma * step, manifold)) return std::nullopt;
  for (LineEnd& end : manifold.ends) end.free_air_m3 = fem::free_air_m3(gas_, end.pressure_Pa, end.volume_at_m3(end.pressure_Pa));
  return manifold;
}

/// Books the air and the works of a step; works are those of the mean of both pressures.
bool PneumaticSupply::settle(const PneumaticState& from, const Group& group, const Manifold& end, double time_s,
                             PneumaticState& to) const {
  const double root_before = root_pressure_Pa(from, group);
  const double root_energy = mean(flow_energy_J_per_m3(gas_, root_before), flow_energy_J_per_m3(gas_, end.pressure_Pa));
  for (std::size_t i = 0; i < group.plena.size(); ++i) {
    const std::size_t j = group.plena[i];
    const LineEnd& here = end.ends[i];
    const double before = pressure_Pa(from, j);
    const double carried = here.free_air_m3 - from.plenum_air_m3[j];
    to.plenum_air_m3[j] = here.free_air_m3;
    if (here.plenum != nullptr) to.volumes_m3[j] = here.plenum->volume_m3(here.pressure_Pa);
    if (group.piston)
      to.piston_air_m3[*group.piston] -= carried;
    else {
      to.source_air_m3[j] += carried;
      to.work.source_J += root_energy * carried;
    }
    to.work.plenum_J += mean(before, here.pressure_Pa) * (to.volumes_m3[j] - from.volumes_m3[j]);
    to.work.line_J +=
        (root_energy - mean(flow_energy_J_per_m3(gas_, before), flow_energy_J_per_m3(gas_, here.pressure_Pa))) * carried;
  }
  if (!group.piston) return true;
  if (!(to.piston_air_m3[*group.piston] > 0.0)) return false;
  const double displaced = root_volume_m3(group, from.time_s) - root_volume_m3(group, time_s);
  to.work.piston_J += mean(root_before, end.pressure_Pa) * displaced;
  return true;
}

}  // namespace menger::fem
