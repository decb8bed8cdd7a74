#include "fem/stall_map/stall_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "fem/pneumatics/pneumatic_integrator.h"

namespace menger::fem {
namespace {

/// Updates the extremes of a period with a state.
void observe(const PneumaticSupply& supply, const PneumaticState& state, StallPoint& point) {
  const double pressure = supply.pressure_Pa(state, 0);
  point.peak_pressure_Pa = std::max(point.peak_pressure_Pa, pressure);
  point.lowest_pressure_Pa = std::min(point.lowest_pressure_Pa, pressure);
  point.piston_peak_pressure_Pa = std::max(point.piston_peak_pressure_Pa, supply.piston_pressure_Pa(state, 0));
  point.largest_volume_m3 = std::max(point.largest_volume_m3, state.volumes_m3[0]);
  point.smallest_volume_m3 = std::min(point.smallest_volume_m3, state.volumes_m3[0]);
  point.largest_flow_m3_per_s = std::max(point.largest_flow_m3_per_s, std::abs(supply.flow_m3_per_s(state, 0).value_or(0.0)));
}

/// Advances a point by a period and updates its extremes.
/// @return completed, diverged if the plenum left its curve, or not_converged if the integrator failed
io::RunStatus pass_period(const PneumaticSupply& supply, PneumaticIntegrator& air, const std::vector<PlenumCompliance>& plena,
                          PneumaticState& state, StallPoint& point) {
  point.peak_pressure_Pa = point.lowest_pressure_Pa = supply.pressure_Pa(state, 0);
  point.piston_peak_pressure_Pa = supply.piston_pressure_Pa(state, 0);
  point.largest_volume_m3 = point.smallest_volume_m3 = state.volumes_m3[0];
  point.largest_flow_m3_per_s = 0.0;
  // The error of a step must not count as suction beyond a curve that begins at the fill.
  const double error_Pa = 1e-4 * (plena[0].pressures_Pa.back() - plena[0].pressures_Pa.front());
  const auto stays_on_curve = [&](const PneumaticState& now) {
    observe(supply, now, point);
    const double pressure = supply.pressure_Pa(now, 0);
    return pressure <= plena[0].pressures_Pa.back() && pressure >= plena[0].pressures_Pa.front() - error_Pa;
  };
  const double end_s = static_cast<double>(point.periods + 1) / point.frequency_Hz;
  const io::RunStatus status = air.advance(state, end_s, plena, stays_on_curve).status;
  if (status == io::RunStatus::stopped) return io::RunStatus::diverged;
  return status == io::RunStatus::completed ? status : io::RunStatus::not_converged;
}

/// Returns the measured pressure at a point, Pa.
double measured_Pa(const StallPoint& point, PressureMeasure measure) {
  return measure == PressureMeasure::peak ? point.peak_pressure_Pa : point.peak_pressure_Pa - point.lowest_pressure_Pa;
}

/// Returns the stroke that reaches a pressure, between a stroke that stays below it and one that leaves the plenum's curve. Empty
/// if the curve ends first, as it does for a swing about a high mean.
std::optional<double> stroke_before_end(const StallMapStudy& study, const StallPoint& beyond, double stroke_m,
                                        PressureMeasure measure, double pressure_Pa) {
  double low = stroke_m;
  double high = beyond.stroke_m;
  std::optional<double> found;
  for (int n = 0; n < 20; ++n) {  // to a millionth of the interval
    const double middle = std::midpoint(low, high);
    const StallPoint point = stall_point(study, beyond.frequency_Hz, beyond.resistance_Pa_s_per_m3, middle);
    const bool is_reached = point.status == io::RunStatus::completed && measured_Pa(point, measure) >= pressure_Pa;
    if (is_reached) found = middle;
    (is_reached || point.status == io::RunStatus::diverged ? high : low) = middle;
  }
  return found;
}

}  // namespace

PneumaticLine line_of(const StallMapStudy& study, double resistance_Pa_s_per_m3) {
  if (study.line_length_m) return round_line_of(*study.line_length_m, resistance_Pa_s_per_m3);
  return {.resistance_Pa_s_per_m3 = resistance_Pa_s_per_m3, .volume_m3 = study.line_volume_m3};
}

StallPoint stall_point(const StallMapStudy& study, double frequency_Hz, double resistance_Pa_s_per_m3, double stroke_m) {
  Piston piston = study.piston;
  piston.stroke_m = stroke_m;
  piston.cylinder_length_m = study.cylinder_length_m.value_or(stroke_m);
  piston.frequency_Hz = frequency_Hz;
  const PneumaticSupply supply({PistonSupply{0, line_of(study, resistance_Pa_s_per_m3)}}, {piston}, study.gas);
  PneumaticIntegrator air(supply, {.tolerance = 1e-6,
                                   .largest_step_s = 1.0 / (frequency_Hz * static_cast<double>(study.steps_per_period)),
                                   .with_works = false});
  const std::vector<PlenumCompliance> plena{study.plenum};
  PneumaticState state = supply.start(0.0, std::vector<double>{study.plenum.volume_m3(piston.fill_pressure_Pa)});
  StallPoint point{.frequency_Hz = frequency_Hz,
                   .resistance_Pa_s_per_m3 = resistance_Pa_s_per_m3,
                   .stroke_m = stroke_m,
                   .status = io::RunStatus::not_converged};
  double last_peak = 0.0;
  while (point.periods < study.most_periods) {
    const io::RunStatus status = pass_period(supply, air, plena, state, point);
    if (status != io::RunStatus::completed) {
      point.status = status;
      return point;
    }
    ++point.periods;
    const bool is_settled = std::abs(point.peak_pressure_Pa - last_peak) <= study.settled * std::abs(point.peak_pressure_Pa);
    last_peak = point.peak_pressure_Pa;
    if (!is_settled || point.periods < 2) continue;
    point.status = io::RunStatus::completed;
    return point;
  }
  return point;
}

StallMap stall_map(const StallMapStudy& study, const std::atomic<bool>* stop, const std::function<void(double)>& progress) {
  StallMap map;
  const std::size_t total = study.frequencies_Hz.size() * study.resistances_Pa_s_per_m3.size() * study.strokes_m.size();
  for (const double frequency : study.frequencies_Hz) {
    for (const double resistance : study.resistances_Pa_s_per_m3) {
      for (const double stroke : study.strokes_m) {
        if (stop != nullptr && *stop) {
          map.status = io::RunStatus::stopped;
          return map;
        }
        map.points.push_back(stall_point(study, frequency, resistance, stroke));
        if (progress) progress(static_cast<double>(map.points.size()) / static_cast<double>(total));
      }
    }
  }
  return map;
}

Isobar isobar(const StallMapStudy& study, const StallMap& map, std::size_t frequency, PressureMeasure measure,
              double pressure_Pa) {
  const std::size_t strokes = study.strokes_m.size();
  const std::size_t resistances = study.resistances_Pa_s_per_m3.size();
  assert(map.points.size() == study.frequencies_Hz.size() * resistances * strokes);
  const bool is_peak = measure == PressureMeasure::peak;
  Isobar result{measure, study.frequencies_Hz[frequency], pressure_Pa, {}};
  for (std::size_t r = 0; r < resistances; ++r) {
    // Without a stroke the pressure is that of the fill.
    double stroke = 0.0;
    double before = is_peak ? study.piston.fill_pressure_Pa : 0.0;
    std::optional<double> found;
    for (std::size_t s = 0; s < strokes && !found; ++s) {
      const StallPoint& point = map.points[(frequency * resistances + r) * strokes + s];
      if (point.status == io::RunStatus::diverged && before < pressure_Pa)
        found = stroke_before_end(study, point, stroke, measure, pressure_Pa);
      if (point.status != io::RunStatus::completed) break;
      const double reached = measured_Pa(point, measure);
      if (before < pressure_Pa && reached >= pressure_Pa)
        found = std::lerp(stroke, point.stroke_m, (pressure_Pa - before) / (reached - before));
      stroke = point.stroke_m;
      before = reached;
    }
    result.strokes_m.push_back(found);
  }
  return result;
}

}  // namespace menger::fem
