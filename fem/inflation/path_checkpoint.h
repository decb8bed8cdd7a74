#pragma once

#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fem/inflation/observables.h"
#include "fem/statics/inflation_path.h"

namespace menger::fem {

/// How a path ended that is not to be taken up again.
struct PathOutcome {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason;
  std::vector<LimitPoint> limit_points;
  int rejected_steps = 0;
};

/// A path that is under way or at its end: where it can be taken up, and what was observed at its points.
struct PathProgress {
  PathRestart restart;
  std::vector<std::vector<PointObservation>> observations;  ///< per point of the path, per named point
  std::vector<std::optional<Point>> extent_changes_m;       ///< per point of the path, see InflationResult
  std::optional<PathOutcome> outcome;                       ///< none while it is under way
};

/// Writes a checkpoint on the first rank, with the states of all ranks, whole or not at all. Collective.
/// @param identity what the path depends on; reading demands the same
/// @throws io::InputError on all ranks if the place cannot be written
void write_checkpoint(const std::filesystem::path& file, const std::string& identity, const PathProgress& progress,
                      MPI_Comm communicator);

/// Reads a checkpoint, every rank its own states; nothing if there is no such file. Collective. Numbers come back exactly. The
/// file is binary in the byte order of the machine and holds a hash of its content.
/// @throws io::InputError on all ranks if it is damaged, of another identity, or of another number of ranks
std::optional<PathProgress> read_checkpoint(const std::filesystem::path& file, const std::string& identity,
                                            MPI_Comm communicator);

}  // namespace menger::fem
