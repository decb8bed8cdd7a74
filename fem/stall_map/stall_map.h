#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fem/pneumatics/pneumatic_gas.h"
#include "fem/pneumatics/pneumatic_line.h"
#include "fem/pneumatics/pneumatic_piston.h"
#include "fem/surfaces/plenum_compliance.h"
#include "io/text/run_status.h"
#include "meshes/design/design_file.h"

namespace menger::fem {

/// A pressure at a frequency that is marked on the map.
struct StallMark {
  std::string label;
  double pressure_Pa = 0.0;   ///< > 0, gauge
  double frequency_Hz = 0.0;  ///< one of the frequencies of the map
};

/// A robot that walks at some points of the map, see stall_travels.
struct StallWalker {
  meshes::Design design{};             ///< basal body
  std::filesystem::path parameters{};  ///< of the voxels, see voxel::read_surrogate
  std::string parameters_text{};
  int level = 1;                     ///< of the fractal, >= 1
  double static_friction = 1.0;      ///< >= kinetic
  double kinetic_friction = 0.5;     ///< >= 0
  std::size_t periods = 6;           ///< simulated periods, >= 2; the first is not evaluated
  std::size_t every_resistance = 1;  ///< walks at the first resistance, then at every n-th
  std::size_t every_stroke = 1;      ///< walks at the longest stroke, then at every n-th down from it
};

/// A study of `menger stall-map`: the pressures that a piston behind a line can give to a soft body. The body has no inertia: the
/// volume of its plenum follows the pressure.
struct StallMapStudy {
  std::filesystem::path file;  ///< from which it was read, for messages
  PlenumCompliance plenum;     ///< of everything connected to the line
  Piston piston;               ///< bore, dead volume and fill; stroke, cylinder and frequency depend on the point of the map
  /// At least the longest stroke; empty: each cylinder is as long as its stroke.
  std::optional<double> cylinder_length_m{};
  double line_volume_m3 = 0.0;  ///< >= 0, of a line with laminar flow
  /// > 0; instead of that volume: the length of a round tube for each resistance, see round_line_of.
  std::optional<double> line_length_m{};
  PneumaticGas gas;
  std::vector<double> frequencies_Hz;           ///< > 0
  std::vector<double> resistances_Pa_s_per_m3;  ///< > 0, increasing in equal ratios
  std::vector<double> strokes_m;                ///< > 0, increasing in equal steps from 0, without 0; within the cylinder
  std::vector<double> isobars_Pa;               ///< > 0
  std::vector<StallMark> marks;
  std::optional<StallWalker> walker{};
  /// Smallest number of steps, >= 20; the integrator takes more where its tolerance needs them.
  std::size_t steps_per_period = 200;
  std::size_t most_periods = 2000;  ///< >= 2
  /// > 0: largest change of the peak from one period to the next, over the peak, at which it counts as settled.
  double settled = 1e-6;
  std::map<std::string, std::string> inputs{};  ///< content hash of every file that was read
};

/// A point of the map: the last period of a run that begins at the fill pressure with the piston withdrawn.
///
/// Extremes are turning points, found between the integrator's steps. Status:
/// - `completed`: the peak has settled.
/// - `not_converged`: the peak has not settled after most_periods, or no step met the tolerance.
/// - `diverged`: the pressure left the range of the plenum's curve. All numbers are then those of the period up to there.
struct StallPoint {
  double frequency_Hz = 0.0;
  double resistance_Pa_s_per_m3 = 0.0;
  double stroke_m = 0.0;
  io::RunStatus status = io::RunStatus::completed;
  double peak_pressure_Pa = 0.0;  ///< of the plenum, gauge
  double lowest_pressure_Pa = 0.0;
  double piston_peak_pressure_Pa = 0.0;
  double largest_volume_m3 = 0.0;  ///< of the plenum
  double smallest_volume_m3 = 0.0;
  double largest_flow_m3_per_s = 0.0;  ///< of free air, magnitude
  std::size_t periods = 0;
};

/// The measure of the plenum's pressure. Behind a line of high resistance the peak remains, but the swing is lost.
enum class PressureMeasure {
  peak,  ///< highest in a period
  swing  ///< highest minus lowest in a period
};

/// The shortest strokes that reach a peak or a swing, by linear interpolation between the strokes of the map; empty where none
/// does. Behind a narrow line a longer stroke can lower the swing: it raises the mean pressure, at which the body is softer.
struct Isobar {
  PressureMeasure measure = PressureMeasure::peak;
  double frequency_Hz = 0.0;
  double pressure_Pa = 0.0;
  std::vector<std::optional<double>> strokes_m;  ///< per resistance
};

/// A map with all its points.
struct StallMap {
  io::RunStatus status = io::RunStatus::completed;  ///< `stopped`: fewer points
  std::vector<StallPoint> points;                   ///< in the order of frequency, resistance, stroke
};

/// Returns the line of a study with a resistance.
PneumaticLine line_of(const StallMapStudy& study, double resistance_Pa_s_per_m3);

/// Computes a point of the map.
StallPoint stall_point(const StallMapStudy& study, double frequency_Hz, double resistance_Pa_s_per_m3, double stroke_m);

/// Computes all points of the map.
/// @param progress called with the fraction that is done
[[nodiscard]] StallMap stall_map(const StallMapStudy& study, const std::atomic<bool>* stop = nullptr,
                                 const std::function<void(double)>& progress = {});

/// Returns an isobar of a complete map. Between the last stroke that stays on the plenum's curve and the first that leaves it,
/// the stroke is found by bisection.
/// @param frequency index among the study's frequencies
/// @param pressure_Pa above the fill, on the plenum's curve
Isobar isobar(const StallMapStudy& study, const StallMap& map, std::size_t frequency, PressureMeasure measure,
              double pressure_Pa);

}  // namespace menger::fem
