#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/stall_map/stall_map.h"
#include "io/text/csv_table.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// The displacement of the robot at a point of the map.
///
/// The robot is a body of calibrated voxels. A sine between the lowest and the highest pressure of the point's plenum drives its
/// chambers in phase. The motion of the body does not act back on the map's supply. The amplitude grows over the first period,
/// which is not evaluated.
struct StallTravel {
  std::size_t point = 0;  ///< index of the point in the map
  io::RunStatus status = io::RunStatus::stopped;
  bool is_refused = false;  ///< the voxels cannot be driven in this way; there is no status
  /// Where the model left its range of validity, or why it did not complete or was refused.
  std::string remark{};
  std::optional<double> displacement_x_m{};  ///< over the evaluated periods; present exactly if completed
  std::optional<double> displacement_y_m{};
  std::optional<double> body_lengths_per_minute{};  ///< horizontal
};

/// Options of walks that do not change their results.
struct StallTravelOptions {
  std::filesystem::path programs;  ///< folder of menger-simulate
  /// A folder per walk, named by a hash of everything that it depends on, so that a finished one is found again.
  std::filesystem::path runs;
  int jobs = 1;  ///< number of walks at the same time
  const std::atomic<bool>* stop = nullptr;
  std::function<void(std::size_t done)> progress{};  ///< never called concurrently
};

/// Returns the indices in a complete map of the points at which the study asks for walks and that completed, in the order of
/// frequency, resistance, stroke.
std::vector<std::size_t> travel_points(const StallMapStudy& study, const StallMap& map);

/// Returns the scene of `menger simulate` for a point.
std::string travel_scene(const StallMapStudy& study, const StallPoint& point);

/// Computes the walks at all points of travel_points.
/// @return empty if the user stopped it; finished walks are kept
/// @throws io::InputError if the program is missing or rejects every scene, or the folder cannot be written
std::optional<std::vector<StallTravel>> stall_travels(const StallMapStudy& study, const StallMap& map,
                                                      const StallTravelOptions& options);

/// Returns a table with one row per walk: frequency_Hz, resistance_Pa_s_per_m3, stroke_m, lowest_pressure_Pa, peak_pressure_Pa,
/// status (or refused), displacement_x_m, displacement_y_m, body_lengths_per_minute, remark.
io::CsvTable travel_table(const StallMap& map, const std::vector<StallTravel>& travels);

}  // namespace menger::fem
