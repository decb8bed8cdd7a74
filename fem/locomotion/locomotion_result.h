#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fem/motion/explicit_energy.h"
#include "fem/surfaces/point.h"
#include "io/text/csv_table.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// A body at one time of its run.
struct LocomotionRecord {
  double time_s = 0.0;
  Point centre_of_mass_m{};
  std::vector<double> plenum_pressures_Pa{};  ///< gauge
  std::vector<double> chamber_volumes_m3{};
  ExplicitEnergies energies{};
  double ground_force_N = 0.0;  ///< upwards
};

/// What a run gave.
struct LocomotionResult {
  io::RunStatus status = io::RunStatus::stopped;
  std::string reason{};  ///< empty when completed; otherwise what, where and when
  double time_s = 0.0;   ///< reached
  std::size_t steps = 0;
  std::size_t elements = 0;
  std::size_t nodes = 0;
  double body_length_m = 0.0;
  double ground_height_m = 0.0;
  std::vector<std::string> plenum_names{};
  std::vector<std::string> chamber_names{};
  std::vector<LocomotionRecord> records{};  ///< the first at the start; of a run that failed, the last at what was reached
  std::vector<std::string> notes{};
  double seconds = 0.0;  ///< wall time up to its end, of the runs that it was taken up from, too
};

/// How far and where to.
struct Travel {
  Point displacement_m{};                  ///< of the centre of mass
  double horizontal_displacement_m = 0.0;  ///< its length in the plane of the ground
  double horizontal_displacement_body_lengths = 0.0;
  double body_lengths_per_minute = 0.0;
  double direction_deg = 0.0;  ///< from +x towards +y, in (-180, 180]; 0 without displacement
};

/// From the first record to the last; nothing for a run that did not complete, which has no displacement to compare.
std::optional<Travel> travel_of(const LocomotionResult& result);

/// Largest height of the centre of mass above the ground over the records, m.
double peak_height_m(const LocomotionResult& result);

/// One line per record; the first columns are those of the surrogate's trajectory.
io::CsvTable trajectory_table(const LocomotionResult& result);

/// The text of locomotion.toml. Of its lines, `seconds` alone is another one each time.
std::string result_text(const LocomotionResult& result);

}  // namespace menger::fem
