#include "fem/pneumatics/pneumatic_flow.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace menger::fem {
namespace {

enum Work : std::size_t { piston_work, source_work, plenum_work, line_work };

constexpr double infinite = std::numeric_limits<double>::infinity();

/// V / N, the derivative of flow_energy_J_per_m3 by pressure.
double volume_per_air(const PneumaticGas& gas, double pressure_Pa) {
  const double ratio = 1.0 + pressure_Pa / gas.ambient_pressure_Pa;
  return gas.exponent == 1.0 ? 1.0 / ratio : std::pow(ratio, -1.0 / gas.exponent);
}

/// Solves for the pressure by Newton's method. It starts from the solution for n = 1, which is a quadratic equation.
std::optional<double> pressure_of(const PneumaticGas& gas, double volume_m3, double compliance, double air_m3) {
  const double ambient = gas.ambient_pressure_Pa;
  const double linear = volume_m3 / ambient + compliance;
  const double root = linear * linear + 4.0 * compliance / ambient * (air_m3 - volume_m3);
  const double divisor = linear + std::sqrt(root);
  if (!(divisor > 0.0)) return std::nullopt;
  double pressure = 2.0 * (air_m3 - volume_m3) / divisor;
  if (!(pressure > -ambient)) return std::nullopt;
  if (gas.exponent == 1.0) return pressure;
  double last = infinite;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const double per_air = volume_per_air(gas, pressure);
    const double absolute = pressure + ambient;
    const double volume = volume_m3 + compliance * pressure;
    const double change = (air_m3 * per_air - volume) / (compliance + volume / (gas.exponent * absolute));
    pressure += std::clamp(change, -0.8 * absolute, 4.0 * absolute);
    // What rounding leaves of the difference of two volumes does not shrink any more.
    const double size = std::abs(change) / absolute;
    if (size <= 1e-15 || (size < 1e-12 && size >= last)) return pressure;
    last = size;
  }
  return std::nullopt;
}

/// The flow times the resistance in a mode. Beyond the end of the turbulent mode the law continues along its tangent.
ResistedFlow flow_in_mode(double drive_Pa, double laminar_drive_Pa, double turbulent_sign) {
  if (turbulent_sign == 0.0) return {drive_Pa, 1.0};
  const double size = turbulent_sign * drive_Pa;
  if (size >= laminar_drive_Pa) return resisted_flow(drive_Pa, laminar_drive_Pa);
  return {turbulent_sign * (laminar_drive_Pa + 4.0 / 7.0 * (size - laminar_drive_Pa)), 4.0 / 7.0};
}

}  // namespace

std::optional<AirPressure> pressure_in(const PneumaticGas& gas, double volume_m3, double compliance_m3_per_Pa, double air_m3) {
  if (!(air_m3 > 0.0)) return std::nullopt;
  if (compliance_m3_per_Pa == 0.0) {
    if (!(volume_m3 > 0.0)) return std::nullopt;
    const double filling = (air_m3 - volume_m3) / volume_m3;
    const double pressure =
        gas.ambient_pressure_Pa * (gas.exponent == 1.0 ? filling : std::expm1(gas.exponent * std::log1p(filling)));
    return AirPressure{pressure, gas.exponent * (pressure + gas.ambient_pressure_Pa) / air_m3};
  }
  const std::optional<double> pressure = pressure_of(gas, volume_m3, compliance_m3_per_Pa, air_m3);
  if (!pressure) return std::nullopt;
  const double volume = volume_m3 + compliance_m3_per_Pa * *pressure;
  if (!(volume > 0.0)) return std::nullopt;
  const double air_by_pressure =
      air_m3 * (compliance_m3_per_Pa / volume + 1.0 / (gas.exponent * (*pressure + gas.ambient_pressure_Pa)));
  return AirPressure{*pressure, 1.0 / air_by_pressure};
}

PneumaticFlow::PneumaticFlow(const PneumaticSupply& supply, bool with_works)
    : supply_(supply),
      with_works_(with_works),
      roots_(supply.groups().size()),
      group_of_(supply.plenum_count(), supply.groups().size()),
      line_of_(supply.plenum_count()),
      volumes_(supply.plenum_count()),
      pieces_(supply.plenum_count(), 0),
      curve_airs_m3_(supply.plenum_count()) {
  for (std::size_t g = 0; g < roots_.size(); ++g) {
    const PneumaticSupply::Group& group = supply.groups()[g];
    for (const std::size_t j : group.plena) {
      const PneumaticLine& line = *supply.line(j);
      group_of_[j] = g;
      roots_[g].half_lines_m3 += 0.5 * line.volume_m3;
      if (line.resistance_Pa_s_per_m3 == 0.0) {
        roots_[g].joined.push_back(j);
        continue;
      }
      line_of_[j] = lines_.size();
      roots_[g].lines.push_back(lines_.size());
      lines_.push_back({.plenum = j,
                        .group = g,
                        .resistance_Pa_s_per_m3 = line.resistance_Pa_s_per_m3,
                        .laminar_drive_Pa = fem::laminar_drive_Pa(supply.gas(), line)});
      if (lines_.back().laminar_drive_Pa < infinite) mode_events_.push_back(lines_.size() - 1);
      turning_points_.push_back({Turn::plenum, lines_.size() - 1});
      if (group.piston) turning_points_.push_back({Turn::drive, lines_.size() - 1});
    }
    if (group.piston) turning_points_.push_back({Turn::piston, g});
  }
  with_works_ = with_works_ || lines_.empty();  // the integrator needs at least one unknown
  evaluated_airs_m3_.resize(lines_.size());
}

void PneumaticFlow::begin(const PneumaticState& from, double duration_s, const PlenumWalls& walls) {
  from_ = from;
  duration_s_ = duration_s;
  walls_ = walls;
  energy_scale_J_ = 0.0;
  set_smooth_part(0.0, duration_s);
  for (std::size_t g = 0; g < roots_.size(); ++g) {
    const PneumaticSupply::Group& group = supply_.groups()[g];
    Root& root = roots_[g];
    root.closed_air_m3 = group.piston ? from.piston_air_m3[*group.piston] : 0.0;
    for (const std::size_t j : group.plena) {
      root.closed_air_m3 += from.plenum_air_m3[j];
      energy_scale_J_ += supply_.gas().ambient_pressure_Pa * from.plenum_air_m3[j];
      const double half = 0.5 * supply_.line(j)->volume_m3;
      if (walls.compliances.empty()) {
        volumes_[j] = {.volume_m3 = from.volumes_m3[j] + half,
                       .rate_m3_per_s = (walls.volumes_m3[j] - from.volumes_m3[j]) / duration_s};
      } else {
        take_curve(j);
      }
    }
  }
  for (Line& line : lines_) {
    const double drive = line_drive_Pa(supply_.gas(), supply_.root_pressure_Pa(from, supply_.groups()[line.group]),
                                       supply_.pressure_Pa(from, line.plenum));
    line.turbulent_sign = std::abs(drive) > line.laminar_drive_Pa ? std::copysign(1.0, drive) : 0.0;
  }
}

/// Stores the free air of a plenum at each point of its compliance curve, and chooses the piece of the pressure at the start.
void PneumaticFlow::take_curve(std::size_t plenum) {
  const PlenumCompliance& curve = walls_.compliances[plenum];
  const double half = 0.5 * supply_.line(plenum)->volume_m3;
  std::vector<double>& airs = curve_airs_m3_[plenum];
  airs.resize(curve.pressures_Pa.size());
  for (std::size_t n = 0; n < airs.size(); ++n)
    airs[n] = free_air_m3(supply_.gas(), curve.pressures_Pa[n], curve.volumes_m3[n] + half);
  set_piece(plenum, static_cast<std::size_t>(std::ranges::upper_bound(airs, from_.plenum_air_m3[plenum]) - airs.begin()));
}

/// Sets the volume as a function of pressure on one straight piece: the one below a point of the curve, or the one beyond the
/// last point.
void PneumaticFlow::set_piece(std::size_t plenum, std::size_t piece) {
  const PlenumCompliance& curve = walls_.compliances[plenum];
  const double half = 0.5 * supply_.line(plenum)->volume_m3;
  pieces_[plenum] = piece;
  LinearVolume& volume = volumes_[plenum];
  volume = {.volume_m3 = half + (piece == 0 ? curve.volumes_m3.front() : curve.volumes_m3[piece - 1])};
  if (piece == 0 || piece == curve.pressures_Pa.size()) return;
  volume.compliance_m3_per_Pa =
      (curve.volumes_m3[piece] - curve.volumes_m3[piece - 1]) / (curve.pressures_Pa[piece] - curve.pressures_Pa[piece - 1]);
  volume.volume_m3 -= volume.compliance_m3_per_Pa * curve.pressures_Pa[piece - 1];
}

void PneumaticFlow::set_smooth_part(double begin_s, double end_s) {
  begin_s_ = begin_s;
  end_s_ = end_s;
  is_evaluated_ = false;
}

double PneumaticFlow::smooth_part_end_s(double begin_s) const {
  const double start = from_.time_s;
  double end = start + duration_s_;
  const auto consider = [&](std::optional<double> corner) {
    if (corner) end = std::min(end, *corner);
  };
  // A corner that differs by rounding from the end of a part is that end.
  const double least = start + begin_s + 1e-9 * duration_s_;
  for (const PneumaticSupply::Group& group : supply_.groups()) {
    if (!group.piston)
      consider(next_corner_s(supply_.source(group), least));
    else if (supply_.pistons()[*group.piston].ramp_s > least)
      consider(supply_.pistons()[*group.piston].ramp_s);
  }
  return end < start + (1.0 - 1e-9) * duration_s_ ? end - start : duration_s_;
}

void PneumaticFlow::start_unknowns(std::span<double> unknowns) const {
  assert(unknowns.size() == unknown_count());
  std::ranges::fill(unknowns, 0.0);
  for (std::size_t l = 0; l < lines_.size(); ++l) unknowns[l] = from_.plenum_air_m3[lines_[l].plenum];
}

/// The time at which schedules are evaluated: it keeps off the ends of the smooth part by more than times are rounded. Otherwise
/// rounding would decide on which side of a corner it lies.
double PneumaticFlow::schedule_time_s(double since_s) const {
  const double margin = 1e-12 * (end_s_ - begin_s_) + 1e-15 * (from_.time_s + end_s_);
  return from_.time_s + std::clamp(since_s, begin_s_ + margin, end_s_ - margin);
}

double PneumaticFlow::volume_m3(std::size_t plenum, double since_s) const {
  return volumes_[plenum].volume_m3 + volumes_[plenum].rate_m3_per_s * since_s;
}

bool PneumaticFlow::evaluate_root(std::size_t group, double since_s, std::span<const double> unknowns) {
  Root& root = roots_[group];
  const PneumaticSupply::Group& parts = supply_.groups()[group];
  const double time = schedule_time_s(since_s);
  if (!parts.piston) {
    root.air = {.pressure_Pa = fem::pressure_Pa(supply_.source(parts), time)};
    return true;
  }
  const Piston& piston = supply_.pistons()[*parts.piston];
  root.cylinder_rate_m3_per_s = cylinder_rate_m3_per_s(piston, time);
  const double cylinder = cylinder_volume_m3(piston, from_.time_s + since_s) + root.half_lines_m3;
  double air = root.closed_air_m3;
  for (const std::size_t l : root.lines) air -= unknowns[l];
  for (int last = 0;;) {
    LinearVolume whole{.volume_m3 = cylinder};
    for (const std::size_t j : root.joined) {
      whole.volume_m3 += volume_m3(j, since_s);
      whole.compliance_m3_per_Pa += volumes_[j].compliance_m3_per_Pa;
    }
    const std::optional<AirPressure> found = pressure_in(supply_.gas(), whole.volume_m3, whole.compliance_m3_per_Pa, air);
    if (!found) return false;
    root.air = *found;
    const int moved = walls_.compliances.empty() ? 0 : move_piece(root);
    // Air grows with pressure, so pieces are passed in one direction. Only rounding at a point of the curve reverses it.
    if (moved == 0 || moved == -last) return true;
    last = moved;
  }
}

/// If the pressure of a cylinder lies beyond the piece of a joined plenum, changes to the next piece of the plenum whose piece
/// was left furthest behind. @return 1 upwards, -1 downwards, 0 if the pressure lies in all pieces
int PneumaticFlow::move_piece(const Root& root) {
  const double pressure = root.air.pressure_Pa;
  std::optional<std::size_t> passed;
  double furthest = 0.0;
  int direction = 0;
  for (const std::size_t j : root.joined) {
    const std::vector<double>& points = walls_.compliances[j].pressures_Pa;
    const std::size_t piece = pieces_[j];
    const double above = piece == points.size() ? 0.0 : pressure - points[piece];
    const double below = piece == 0 ? 0.0 : points[piece - 1] - pressure;
    if (!(std::max(above, below) > furthest)) continue;
    furthest = std::max(above, below);
    passed = j;
    direction = above > 0.0 ? 1 : -1;
  }
  if (passed) set_piece(*passed, direction > 0 ? pieces_[*passed] + 1 : pieces_[*passed] - 1);
  return direction;
}

bool PneumaticFlow::evaluate_line(std::size_t l, double since_s, double air_m3) {
  Line& line = lines_[l];
  if (!walls_.compliances.empty()) {
    const std::vector<double>& airs = curve_airs_m3_[line.plenum];
    const auto piece = static_cast<std::size_t>(std::ranges::upper_bound(airs, air_m3) - airs.begin());
    if (piece != pieces_[line.plenum]) set_piece(line.plenum, piece);
  }
  const LinearVolume& volume = volumes_[line.plenum];
  const std::optional<AirPressure> found =
      pressure_in(supply_.gas(), volume_m3(line.plenum, since_s), volume.compliance_m3_per_Pa, air_m3);
  if (!found) return false;
  line.air = *found;
  line.drive_Pa = line_drive_Pa(supply_.gas(), roots_[line.group].air.pressure_Pa, line.air.pressure_Pa);
  const ResistedFlow flow = flow_in_mode(line.drive_Pa, line.laminar_drive_Pa, line.turbulent_sign);
  line.flow_m3_per_s = flow.flow_Pa / line.resistance_Pa_s_per_m3;
  line.flow_by_drive = flow.by_drive / line.resistance_Pa_s_per_m3;
  return true;
}

bool PneumaticFlow::evaluate(double since_s, std::span<const double> unknowns) {
  const std::span<const double> airs = unknowns.first(lines_.size());
  if (is_evaluated_ && since_s == evaluated_s_ && std::ranges::equal(airs, evaluated_airs_m3_)) return true;
  is_evaluated_ = false;
  for (std::size_t g = 0; g < roots_.size(); ++g)
    if (!evaluate_root(g, since_s, unknowns)) return false;
  for (std::size_t l = 0; l < lines_.size(); ++l)
    if (!evaluate_line(l, since_s, unknowns[l])) return false;
  is_evaluated_ = true;
  evaluated_s_ = since_s;
  std::ranges::copy(airs, evaluated_airs_m3_.begin());
  return true;
}

bool PneumaticFlow::rates(double since_s, std::span<const double> unknowns, std::span<double> result) {
  if (!evaluate(since_s, unknowns)) return false;
  const PneumaticGas& gas = supply_.gas();
  for (std::size_t l = 0; l < lines_.size(); ++l) result[l] = lines_[l].flow_m3_per_s;
  if (!with_works_) return true;
  std::array<double, 4> work{};
  for (std::size_t g = 0; g < roots_.size(); ++g) {
    const Root& root = roots_[g];
    const bool is_source = !supply_.groups()[g].piston;
    if (!is_source) work[piston_work] -= root.air.pressure_Pa * root.cylinder_rate_m3_per_s;
    for (const std::size_t j : root.joined) {
      const double power = root.air.pressure_Pa * volumes_[j].rate_m3_per_s;
      work[plenum_work] += power;
      if (is_source) work[source_work] += power;  // the energy that the air there gains is added in settle_end
    }
    if (root.lines.empty()) continue;
    const double carried = flow_energy_J_per_m3(gas, root.air.pressure_Pa);
    for (const std::size_t l : root.lines) {
      const Line& line = lines_[l];
      if (is_source) work[source_work] += carried * line.flow_m3_per_s;
      work[plenum_work] += line.air.pressure_Pa * volumes_[line.plenum].rate_m3_per_s;
      work[line_work] += (carried - flow_energy_J_per_m3(gas, line.air.pressure_Pa)) * line.flow_m3_per_s;
    }
  }
  std::ranges::copy(work, result.begin() + static_cast<std::ptrdiff_t>(lines_.size()));
  return true;
}

bool PneumaticFlow::jacobian(double since_s, std::span<const double> unknowns, std::span<double* const> columns) {
  if (!evaluate(since_s, unknowns)) return false;
  const PneumaticGas& gas = supply_.gas();
  const std::size_t works = lines_.size();
  for (double* column : columns) std::fill_n(column, unknown_count(), 0.0);
  for (std::size_t g = 0; g < roots_.size(); ++g) {
    const Root& root = roots_[g];
    const bool is_source = !supply_.groups()[g].piston;
    const double root_Pa = root.air.pressure_Pa;
    const double root_by_air = is_source ? 0.0 : -root.air.by_air_Pa_per_m3;  // by the air that left it
    const double carried = root.lines.empty() || !with_works_ ? 0.0 : flow_energy_J_per_m3(gas, root_Pa);
    double joined_rate = 0.0;
    for (const std::size_t j : root.joined) joined_rate += volumes_[j].rate_m3_per_s;
    for (const std::size_t k : root.lines) {
      double* column = columns[k];
      if (with_works_) {
        if (!is_source) column[works + piston_work] = -root_by_air * root.cylinder_rate_m3_per_s;
        column[works + plenum_work] = root_by_air * joined_rate;
      }
      for (const std::size_t l : root.lines) {
        const Line& line = lines_[l];
        const double here_Pa = line.air.pressure_Pa;
        const double here_by_air = l == k ? line.air.by_air_Pa_per_m3 : 0.0;
        const double drive =
            ((root_Pa + gas.ambient_pressure_Pa) * root_by_air - (here_Pa + gas.ambient_pressure_Pa) * here_by_air) /
            gas.ambient_pressure_Pa;
        const double flow = line.flow_by_drive * drive;
        column[l] = flow;
        if (!with_works_) continue;
        if (is_source) column[works + source_work] += carried * flow;
        column[works + plenum_work] += here_by_air * volumes_[line.plenum].rate_m3_per_s;
        column[works + line_work] +=
            (carried - flow_energy_J_per_m3(gas, here_Pa)) * flow +
            (volume_per_air(gas, root_Pa) * root_by_air - volume_per_air(gas, here_Pa) * here_by_air) * line.flow_m3_per_s;
      }
    }
  }
  return true;
}

/// Computes dp/dt in lines and cylinders.
void PneumaticFlow::evaluate_rates() {
  const PneumaticGas& gas = supply_.gas();
  for (Root& root : roots_) {
    double air_rate = 0.0;
    for (const std::size_t l : root.lines) {
      Line& line = lines_[l];
      const double swelling = volumes_[line.plenum].rate_m3_per_s / volume_per_air(gas, line.air.pressure_Pa);
      line.rate_Pa_per_s = (line.flow_m3_per_s - swelling) * line.air.by_air_Pa_per_m3;
      air_rate -= line.flow_m3_per_s;
    }
    double volume_rate = root.cylinder_rate_m3_per_s;
    for (const std::size_t j : root.joined) volume_rate += volumes_[j].rate_m3_per_s;
    root.rate_Pa_per_s = (air_rate - volume_rate / volume_per_air(gas, root.air.pressure_Pa)) * root.air.by_air_Pa_per_m3;
  }
}

double PneumaticFlow::distance_to_turbulence_Pa(const Line& line) const {
  return line.turbulent_sign == 0.0 ? line.laminar_drive_Pa - std::abs(line.drive_Pa)
                                    : line.turbulent_sign * line.drive_Pa - line.laminar_drive_Pa;
}

double PneumaticFlow::rate_of(const TurningPoint& point) const {
  if (point.turn == Turn::piston) return roots_[point.index].rate_Pa_per_s;
  const Line& line = lines_[point.index];
  if (point.turn == Turn::plenum) return line.rate_Pa_per_s;
  const double ambient = supply_.gas().ambient_pressure_Pa;
  const Root& root = roots_[line.group];
  return (root.air.pressure_Pa + ambient) * root.rate_Pa_per_s - (line.air.pressure_Pa + ambient) * line.rate_Pa_per_s;
}

bool PneumaticFlow::events(double since_s, std::span<const double> unknowns, std::span<double> modes,
                           std::span<double> turning_points) {
  if (!evaluate(since_s, unknowns)) return false;
  for (std::size_t n = 0; n < modes.size(); ++n) modes[n] = distance_to_turbulence_Pa(lines_[mode_events_[n]]);
  if (turning_points.empty()) return true;
  evaluate_rates();
  for (std::size_t n = 0; n < turning_points.size(); ++n) turning_points[n] = rate_of(turning_points_[n]);
  return true;
}

void PneumaticFlow::pass(std::size_t mode_event) {
  is_evaluated_ = false;
  Line& line = lines_[mode_events_[mode_event]];
  line.turbulent_sign = line.turbulent_sign == 0.0 ? std::copysign(1.0, line.drive_Pa) : 0.0;
}

/// Sets air and volume of one plenum, and adds the works that follow from both ends of the step alone.
void PneumaticFlow::settle_end(std::size_t plenum, double air_m3, double pressure_Pa, double since_s, PneumaticState& to) const {
  const PneumaticSupply::Group& group = supply_.groups()[group_of_[plenum]];
  const double carried = air_m3 - from_.plenum_air_m3[plenum];
  const double half = 0.5 * supply_.line(plenum)->volume_m3;
  double work = 0.0;
  to.plenum_air_m3[plenum] = air_m3;
  if (walls_.compliances.empty()) {
    to.volumes_m3[plenum] =
        since_s == duration_s_ ? walls_.volumes_m3[plenum] : from_.volumes_m3[plenum] + volumes_[plenum].rate_m3_per_s * since_s;
  } else {
    const PlenumCompliance& curve = walls_.compliances[plenum];
    to.volumes_m3[plenum] = curve.volume_m3(pressure_Pa);
    if (with_works_) work = curve.work_J(supply_.pressure_Pa(from_, plenum), pressure_Pa);
    to.work.plenum_J += work;
  }
  if (group.piston) {
    to.piston_air_m3[*group.piston] -= carried;
    return;
  }
  to.source_air_m3[plenum] += carried;
  if (line_of_[plenum] || !with_works_) return;
  // No line loses energy: what left the source is the energy that the air here gained plus its work.
  to.work.source_J += work + air_energy_J(supply_.gas(), air_m3, to.volumes_m3[plenum] + half) -
                      air_energy_J(supply_.gas(), from_.plenum_air_m3[plenum], from_.volumes_m3[plenum] + half);
}

bool PneumaticFlow::settle(double since_s, std::span<const double> unknowns, PneumaticState& to) {
  if (!evaluate(since_s, unknowns)) return false;
  to = from_;
  to.time_s = from_.time_s + since_s;
  if (with_works_) {
    const std::span<const double> works = unknowns.subspan(lines_.size());
    to.work.piston_J += works[piston_work];
    to.work.source_J += works[source_work];
    to.work.plenum_J += works[plenum_work];
    to.work.line_J += works[line_work];
  }
  for (std::size_t l = 0; l < lines_.size(); ++l)
    settle_end(lines_[l].plenum, unknowns[l], lines_[l].air.pressure_Pa, since_s, to);
  for (std::size_t g = 0; g < roots_.size(); ++g) {
    const PneumaticSupply::Group& group = supply_.groups()[g];
    // A source has its pressure at exactly this time, also where it jumps.
    const double pressure = group.piston ? roots_[g].air.pressure_Pa : fem::pressure_Pa(supply_.source(group), to.time_s);
    for (const std::size_t j : roots_[g].joined) {
      const double volume = walls_.compliances.empty()
                                ? volume_m3(j, since_s)
                                : walls_.compliances[j].volume_m3(pressure) + 0.5 * supply_.line(j)->volume_m3;
      settle_end(j, free_air_m3(supply_.gas(), pressure, volume), pressure, since_s, to);
    }
  }
  for (std::size_t j = 0; j < supply_.plenum_count(); ++j) {
    if (supply_.has_line(j)) continue;
    to.volumes_m3[j] = walls_.compliances.empty() ? std::lerp(from_.volumes_m3[j], walls_.volumes_m3[j], since_s / duration_s_)
                                                  : walls_.compliances[j].volume_m3(supply_.pressure_Pa(to, j));
  }
  return true;
}

}  // namespace menger::fem
