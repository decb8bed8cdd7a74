#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fem/motion/motion_energy.h"
#include "fem/surfaces/point.h"
#include "io/text/csv_table.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// The observed quantities of a body at one time of its run.
struct LocomotionRecord {
  double time_s = 0.0;
  Point centre_of_mass_m{};
  std::vector<double> plenum_pressures_Pa{};  ///< gauge
  std::vector<double> chamber_volumes_m3{};
  MotionEnergies energies{};
  double ground_force_N = 0.0;  ///< upwards
};

/// The result of a run.
struct LocomotionResult {
  io::RunStatus status = io::RunStatus::stopped;
  std::string reason{};  ///< empty if completed; otherwise what failed, where and when
  double time_s = 0.0;   ///< reached
  std::size_t steps = 0;
  std::size_t elements = 0;
  std::size_t nodes = 0;
  double body_length_m = 0.0;
  double ground_height_m = 0.0;
  std::vector<std::string> plenum_names{};
  std::vector<std::string> chamber_names{};
  /// The first is that of the start. If the run failed, the last is that of the time that it reached.
  std::vector<LocomotionRecord> records{};
  std::vector<std::string> notes{};
  double seconds = 0.0;  ///< wall time up to its end, including the runs that it resumed
};

/// The displacement of a body over a run: its length and direction.
struct Travel {
  Point displacement_m{};                  ///< of the centre of mass
  double horizontal_displacement_m = 0.0;  ///< length of the displacement in the plane of the ground
  double horizontal_displacement_body_lengths = 0.0;
  double body_lengths_per_minute = 0.0;
  double direction_deg = 0.0;  ///< from +x towards +y, in (-180, 180]; 0 without displacement
};

/// Returns the travel from the first record to the last. Empty for a run that did not complete, since its displacement cannot be
/// compared.
std::optional<Travel> travel_of(const LocomotionResult& result);

/// Returns the largest height of the centre of mass above the ground over all records, m.
double peak_height_m(const LocomotionResult& result);

/// Returns a table with one line per record; the first columns are those of the surrogate's trajectory.
io::CsvTable trajectory_table(const LocomotionResult& result);

/// Reads locomotion.toml and trajectory.csv of a folder back: everything but names, notes and the columns after the centre of
/// mass.
/// @throws io::InputError with file, key and value
LocomotionResult read_locomotion_result(const std::filesystem::path& folder);

/// Returns the text of locomotion.toml. If a run is repeated, only its line `seconds` differs.
std::string result_text(const LocomotionResult& result);

}  // namespace menger::fem
