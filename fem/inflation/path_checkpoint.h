#pragma once

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/inflation/observables.h"
#include "fem/statics/inflation_path.h"

namespace menger::fem {

/// The outcome of a path that has ended and is not resumed.
struct PathOutcome {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason;
  std::vector<LimitPoint> limit_points;
  int rejected_steps = 0;
};

/// The progress of a path that is under way or has ended: the state from which it can be resumed, and the observations at its
/// points.
struct PathProgress {
  PathRestart restart;
  std::vector<std::vector<PointObservation>> observations;  ///< per point of the path, per named point
  std::vector<std::optional<Point>> extent_changes_m;       ///< per point of the path, see InflationResult
  std::optional<PathOutcome> outcome;                       ///< empty while it is under way
};

/// Writes the progress of an inflation path to a checkpoint file, whole or not at all. Every rank has its part of each state; the
/// first rank collects all parts and writes the file. Collective.
/// @param identity text of everything that the path depends on; read_checkpoint refuses the file if it is given another text
/// @throws io::InputError on all ranks if the file cannot be written
void write_checkpoint(const std::filesystem::path& file, const std::string& identity, const PathProgress& progress,
                      MPI_Comm communicator);

/// Reads a checkpoint, each rank its own states. Empty if there is no such file. Collective. Numbers are restored exactly. The
/// file is binary in the byte order of the machine and contains a hash of its content.
/// @param misfit returns why what was read cannot be of the body, empty if it can; may be empty
/// @throws io::InputError on all ranks if it is damaged, has another identity or number of ranks, or does not fit on one of them
std::optional<PathProgress> read_checkpoint(const std::filesystem::path& file, const std::string& identity, MPI_Comm communicator,
                                            const std::function<std::string(const PathProgress&)>& misfit = {});

}  // namespace menger::fem
