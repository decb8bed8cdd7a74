#include "fem/pneumatics/pneumatic_supply.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "io/text/input_error.h"
#include "io/text/number_text.h"

namespace menger::fem {

PneumaticSupply::PneumaticSupply(std::vector<PlenumSupply> plena, std::vector<Piston> pistons, const PneumaticGas& gas)
    : plena_(std::move(plena)), pistons_(std::move(pistons)), gas_(gas) {
  assert(gas_.exponent > 0.0 && gas_.ambient_pressure_Pa > 0.0);
  for (std::size_t p = 0; p < pistons_.size(); ++p) groups_.push_back({.piston = p});
  for (std::size_t j = 0; j < plena_.size(); ++j) {
    if (std::holds_alternative<LineSupply>(plena_[j])) groups_.push_back({.plena = {j}});
    const auto* piston = std::get_if<PistonSupply>(&plena_[j]);
    assert(piston == nullptr || piston->piston < pistons_.size());
    if (piston != nullptr) groups_[piston->piston].plena.push_back(j);
    assert(line(j) == nullptr || (line(j)->resistance_Pa_s_per_m3 >= 0.0 && line(j)->volume_m3 >= 0.0));
  }
}

const PneumaticLine* PneumaticSupply::line(std::size_t plenum) const {
  if (const auto* supply = std::get_if<LineSupply>(&plena_[plenum])) return &supply->line;
  if (const auto* supply = std::get_if<PistonSupply>(&plena_[plenum])) return &supply->line;
  return nullptr;
}

const PlenumSchedule& PneumaticSupply::source(const Group& group) const {
  return std::get<LineSupply>(plena_[group.plena.front()]).source;
}

bool PneumaticSupply::has_line(std::size_t plenum) const { return line(plenum) != nullptr; }

bool PneumaticSupply::has_lines() const {
  for (std::size_t j = 0; j < plena_.size(); ++j)
    if (has_line(j)) return true;
  return false;
}

double PneumaticSupply::root_volume_m3(const Group& group, double time_s) const {
  if (!group.piston) return 0.0;
  double volume = cylinder_volume_m3(pistons_[*group.piston], time_s);
  for (const std::size_t j : group.plena) volume += 0.5 * line(j)->volume_m3;
  return volume;
}

PneumaticState PneumaticSupply::start(double time_s, std::span<const double> volumes_m3) const {
  assert(volumes_m3.size() == plena_.size());
  PneumaticState state;
  state.time_s = time_s;
  state.volumes_m3.assign(volumes_m3.begin(), volumes_m3.end());
  state.plenum_air_m3.assign(plena_.size(), 0.0);
  state.source_air_m3.assign(plena_.size(), 0.0);
  state.piston_air_m3.assign(pistons_.size(), 0.0);
  for (const Group& group : groups_) {
    const double fill = group.piston ? pistons_[*group.piston].fill_pressure_Pa : 0.0;
    if (group.piston) state.piston_air_m3[*group.piston] = fem::free_air_m3(gas_, fill, root_volume_m3(group, time_s));
    for (const std::size_t j : group.plena)
      state.plenum_air_m3[j] = fem::free_air_m3(gas_, fill, volumes_m3[j] + 0.5 * line(j)->volume_m3);
  }
  return state;
}

double PneumaticSupply::pressure_Pa(const PneumaticState& state, std::size_t plenum) const {
  const PneumaticLine* tube = line(plenum);
  if (tube == nullptr) return fem::pressure_Pa(std::get<PlenumSchedule>(plena_[plenum]), state.time_s);
  return air_pressure_Pa(gas_, state.plenum_air_m3[plenum], state.volumes_m3[plenum] + 0.5 * tube->volume_m3);
}

std::vector<double> PneumaticSupply::pressures_Pa(const PneumaticState& state) const {
  std::vector<double> pressures(plena_.size());
  for (std::size_t j = 0; j < pressures.size(); ++j) pressures[j] = pressure_Pa(state, j);
  return pressures;
}

double PneumaticSupply::root_pressure_Pa(const PneumaticState& state, const Group& group) const {
  if (!group.piston) return fem::pressure_Pa(source(group), state.time_s);
  return air_pressure_Pa(gas_, state.piston_air_m3[*group.piston], root_volume_m3(group, state.time_s));
}

double PneumaticSupply::piston_pressure_Pa(const PneumaticState& state, std::size_t piston) const {
  return root_pressure_Pa(state, groups_[piston]);
}

std::optional<double> PneumaticSupply::flow_m3_per_s(const PneumaticState& state, std::size_t plenum) const {
  const PneumaticLine* tube = line(plenum);
  if (tube == nullptr || tube->resistance_Pa_s_per_m3 == 0.0) return std::nullopt;
  const auto has = [plenum](const Group& group) { return std::ranges::find(group.plena, plenum) != group.plena.end(); };
  const double root = root_pressure_Pa(state, *std::ranges::find_if(groups_, has));
  return line_flow_m3_per_s(gas_, *tube, root, pressure_Pa(state, plenum));
}

double PneumaticSupply::stiffness_Pa_per_m3(const PneumaticState& state, std::size_t plenum) const {
  const PneumaticLine* tube = line(plenum);
  if (tube == nullptr) return 0.0;
  return gas_.exponent * (pressure_Pa(state, plenum) + gas_.ambient_pressure_Pa) /
         (state.volumes_m3[plenum] + 0.5 * tube->volume_m3);
}

double PneumaticSupply::free_air_m3(const PneumaticState& state) const {
  double air = 0.0;
  for (const double part : state.plenum_air_m3) air += part;
  for (const double part : state.piston_air_m3) air += part;
  for (const double part : state.source_air_m3) air -= part;
  return air;
}

double PneumaticSupply::stored_J(const PneumaticState& state) const {
  double energy = 0.0;
  for (const Group& group : groups_) {
    if (group.piston) energy += air_energy_J(gas_, state.piston_air_m3[*group.piston], root_volume_m3(group, state.time_s));
    for (const std::size_t j : group.plena)
      energy += air_energy_J(gas_, state.plenum_air_m3[j], state.volumes_m3[j] + 0.5 * line(j)->volume_m3);
  }
  return energy;
}

void PneumaticSupply::check_resolved(std::span<const std::string> plenum_names, double step_s) const {
  std::vector<PlenumSchedule> schedules;
  for (const PlenumSupply& supply : plena_) {
    if (const auto* schedule = std::get_if<PlenumSchedule>(&supply))
      schedules.push_back(*schedule);
    else if (const auto* source = std::get_if<LineSupply>(&supply))
      schedules.push_back(source->source);
    else
      schedules.push_back({ConstantPressure{}});
  }
  fem::check_resolved(schedules, plenum_names, step_s);
  for (const Piston& piston : pistons_) {
    const auto demand = [&](double duration_s, double steps, const std::string& name) {
      if (duration_s >= steps * step_s) return;
      throw io::InputError("piston \"" + piston.name + "\": a " + name + " of " + io::number_text(duration_s) +
                           " s is too short for steps of " + io::number_text(step_s) + " s");
    };
    demand(1.0 / piston.frequency_Hz, 20.0, "period");
    if (piston.ramp_s > 0.0) demand(piston.ramp_s, 2.0, "ramp");
  }
}

}  // namespace menger::fem
