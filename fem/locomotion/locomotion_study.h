#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fem/pneumatics/pneumatic_supply_file.h"
#include "fem/walk/walk_input.h"

namespace menger::fem {

/// The files that are written besides trajectory and result.
struct LocomotionOutput {
  bool frames = true;
  bool pictures = true;
  std::size_t records_per_frame = 10;  ///< >= 1
};

/// Frames of a walk whose study does not say how many there are, at most. Pages of reports show as many.
inline constexpr std::size_t most_frames_of_walk = 300;

/// Returns how many records there are per frame if a study does not say: so many that each stroke has eight frames, which tells a
/// stroke from the next one and shows its shape, and that no more than 0.1 s lie between two. There are no more frames than
/// records, nor than most_frames_of_walk.
/// @param frequency_Hz of the strokes of the drive, > 0; nothing without strokes
std::size_t usual_records_per_frame(double record_interval_s, double duration_s, std::optional<double> frequency_Hz);

/// The sweep of a study: some of its numbers take several values, with one run for each.
struct LocomotionSweep {
  std::vector<std::string> keys;  ///< numbers that the study states: "ground.static_friction", ...
  std::vector<double> values;     ///< one per case, the same for all keys
};

/// Settings of implicit dynamics in a study; see ImplicitOptions.
struct LocomotionImplicit {
  int degree = 1;                ///< of the elements: 1 (Q1/P0) or 2 (Q2/P1)
  double tolerance = 2e-5;       ///< > 0
  double stick_stiffness = 1.0;  ///< > 0
};

/// A study of `menger locomote`: everything that its results depend on. The physics takes the walk and does not read the file.
struct LocomotionStudy : PreparedWalk {
  std::filesystem::path file;  ///< from which it was read, for messages
  std::string text;            ///< of that file

  StudySupply stated_supply;                     ///< instead of the drive
  std::optional<LocomotionImplicit> implicit{};  ///< empty: explicit dynamics
  LocomotionOutput output;
  std::optional<LocomotionSweep> sweep{};
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read, with the study's own
};

/// Returns everything that the records and frames of a walk or a sweep depend on: the study with defaults filled in and the
/// content of its files inserted. Equal texts give equal files.
std::string locomotion_text(const LocomotionStudy& study);

}  // namespace menger::fem
