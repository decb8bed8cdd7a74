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

/// A pressure at a frequency that is to be found on the map.
struct StallMark {
  std::string label;
  double pressure_Pa = 0.0;   ///< > 0, gauge
  double frequency_Hz = 0.0;  ///< one of the map's
};

/// A robot that walks at some points of the map, see stall_travels.
struct StallWalker {
  meshes::Design design{};             ///< basal body
  std::filesystem::path parameters{};  ///< of the voxels, see voxel::read_surrogate
  std::string parameters_text{};
  int level = 1;                     ///< of the fractal, >= 1
  double static_friction = 1.0;      ///< >= kinetic
  double kinetic_friction = 0.5;     ///< >= 0
  std::size_t periods = 6;           ///< simulated, >= 2; the first does not count
  std::size_t every_resistance = 1;  ///< takes the first, then every so manieth
  std::size_t every_stroke = 1;      ///< takes the longest, then every so manieth down from it
};

/// What a piston behind a line can do to a soft body, without the body's inertia: its plenum's volume follows the pressure.
struct StallMapStudy {
  std::filesystem::path file;  ///< that it came from, for messages
  PlenumCompliance plenum;     ///< all that hangs on the line
  Piston piston;               ///< bore, dead volume and fill; stroke, cylinder and frequency are those of a point of the map
  std::optional<double> cylinder_length_m{};  ///< at least the longest stroke; none: each cylinder is as long as its stroke
  double line_volume_m3 = 0.0;                ///< >= 0, of a line that stays laminar
  std::optional<double> line_length_m{};  ///< > 0; instead of that volume: the round tube of each resistance, see round_line_of
  PneumaticGas gas;
  std::vector<double> frequencies_Hz;           ///< > 0
  std::vector<double> resistances_Pa_s_per_m3;  ///< > 0, increasing in equal ratios
  std::vector<double> strokes_m;                ///< > 0, increasing in equal steps, the first from 0; within the cylinder
  std::vector<double> isobars_Pa;               ///< > 0
  std::vector<StallMark> marks;
  std::optional<StallWalker> walker{};
  std::size_t steps_per_period = 200;           ///< at least, >= 20; the integrator takes more where its tolerance asks for them
  std::size_t most_periods = 2000;              ///< >= 2
  double settled = 1e-6;                        ///< largest change of the peak from one period to the next, of the peak; > 0
  std::map<std::string, std::string> inputs{};  ///< content hash of every file that was read
};

/// A point of the map: the last period of a run that begins at the fill pressure with the piston withdrawn.
///
/// Extremes are turning points, found between the integrator's steps. `completed`: the peak has settled; `not_converged`: it has
/// not after most_periods, or no step kept the tolerance; `diverged`: the pressure left the range of the plenum's curve, and all
/// numbers are those of the period so far.
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
  double largest_flow_m3_per_s = 0.0;  ///< of free air, by size
  std::size_t periods = 0;
};

/// What of the plenum's pressure is meant: behind a line of high resistance the peak stays and the swing is lost.
enum class PressureMeasure {
  peak,  ///< highest in a period
  swing  ///< highest less lowest
};

/// Shortest stroke that reaches a peak or a swing, by straight lines between the strokes of the map; nothing where none does.
/// Behind a narrow line a longer stroke can lower the swing: it raises the mean pressure, at which the body is softer.
struct Isobar {
  PressureMeasure measure = PressureMeasure::peak;
  double frequency_Hz = 0.0;
  double pressure_Pa = 0.0;
  std::vector<std::optional<double>> strokes_m;  ///< per resistance
};

struct StallMap {
  io::RunStatus status = io::RunStatus::completed;  ///< `stopped`: fewer points
  std::vector<StallPoint> points;                   ///< by frequency, resistance, stroke
};

PneumaticLine line_of(const StallMapStudy& study, double resistance_Pa_s_per_m3);

StallPoint stall_point(const StallMapStudy& study, double frequency_Hz, double resistance_Pa_s_per_m3, double stroke_m);

/// All points. @param progress is told the part that is done
[[nodiscard]] StallMap stall_map(const StallMapStudy& study, const std::atomic<bool>* stop = nullptr,
                                 const std::function<void(double)>& progress = {});

/// The isobar of a complete map; between the last stroke that stays on the plenum's curve and the first that leaves it the stroke
/// is found by bisection. @param frequency place among the study's @param pressure_Pa above the fill, on the plenum's curve
Isobar isobar(const StallMapStudy& study, const StallMap& map, std::size_t frequency, PressureMeasure measure,
              double pressure_Pa);

}  // namespace menger::fem
