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

/// How far the robot goes at a point of the map.
///
/// The robot is a body of calibrated voxels whose chambers are driven in phase by a sine between the lowest and the highest
/// pressure of the point's plenum: the map's supply has no load from the body's motion. Its pressure grows over the first period,
/// which is left out of the way.
struct StallTravel {
  std::size_t point = 0;  ///< of the map
  io::RunStatus status = io::RunStatus::stopped;
  bool is_refused = false;  ///< the voxels cannot be driven so: there is no status
  std::string remark{};     ///< where the model left its range of validity, or why it did not complete or was refused
  std::optional<double> displacement_x_m{};  ///< over the periods that count; exists exactly if completed
  std::optional<double> displacement_y_m{};
  std::optional<double> body_lengths_per_minute{};  ///< horizontal
};

/// How walks are run, never what comes out of them.
struct StallTravelOptions {
  std::filesystem::path programs;  ///< folder of menger-simulate
  std::filesystem::path runs;      ///< a folder per walk, named by what decides it: a finished one is found again
  int jobs = 1;                    ///< walks at the same time
  const std::atomic<bool>* stop = nullptr;
  std::function<void(std::size_t done)> progress{};  ///< never called twice at the same time
};

/// Places in a complete map of the points that the study asks for: those that completed, by frequency, resistance, stroke.
std::vector<std::size_t> travel_points(const StallMapStudy& study, const StallMap& map);

/// Scene of `menger simulate` for a point.
std::string travel_scene(const StallMapStudy& study, const StallPoint& point);

/// Walks at all points of travel_points. @return nothing if the user stopped it; what is finished is kept
/// @throws io::InputError if the program is missing or refuses every scene, or the folder cannot be written
std::optional<std::vector<StallTravel>> stall_travels(const StallMapStudy& study, const StallMap& map,
                                                      const StallTravelOptions& options);

/// One row per walk: frequency_Hz, resistance_Pa_s_per_m3, stroke_m, lowest_pressure_Pa, peak_pressure_Pa, status
/// (or refused), displacement_x_m, displacement_y_m, body_lengths_per_minute, remark.
io::CsvTable travel_table(const StallMap& map, const std::vector<StallTravel>& travels);

}  // namespace menger::fem
