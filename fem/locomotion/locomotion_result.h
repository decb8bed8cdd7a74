#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fem/walk/walk_input.h"
#include "fem/walk/walk_result.h"
#include "io/text/csv_table.h"

namespace menger::fem {

/// The result of a run: that of its walk, and what its files name.
struct LocomotionResult : WalkResult {
  std::vector<std::string> plenum_names{};
  std::vector<std::string> chamber_names{};
  std::vector<std::string> notes{};
  double seconds = 0.0;  ///< wall time up to its end, including the runs that it resumed
};

/// Returns the result of a walk with the names of its plena and chambers.
LocomotionResult named_result(const PreparedWalk& walk, WalkResult result);

/// Returns a table with one line per record; the first columns are those of the surrogate's trajectory.
io::CsvTable trajectory_table(const LocomotionResult& result);

/// Reads locomotion.toml and trajectory.csv of a folder back: everything but names, notes, the height of the ground (0 instead)
/// and the columns after the centre of mass.
/// @throws io::InputError with file, key and value
LocomotionResult read_locomotion_result(const std::filesystem::path& folder);

/// Returns the text of locomotion.toml. If a run is repeated, only its line `seconds` differs.
std::string result_text(const LocomotionResult& result);

}  // namespace menger::fem
