#pragma once

#include <mpi.h>

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/inflation/inflation_study.h"
#include "fem/inflation/observables.h"

namespace menger::fem {

/// How a study is run, never what comes out of it (but for `strict`, which may end it sooner).
struct InflationOptions {
  bool restart = false;                     ///< begin anew where a checkpoint would be taken up
  bool strict = false;                      ///< refuse or end where otherwise a note warns, at points of earlier runs, too
  const std::atomic<bool>* stop = nullptr;  ///< ends the run with status `stopped`; what was done is kept
  /// Called on the first rank after every point of the path, with the parameters of its start and end.
  std::function<void(const PathPoint& point, double start_s, double end_s)> progress{};
  MPI_Comm communicator = MPI_COMM_WORLD;
};

/// What a run gave; the same on all ranks.
struct InflationResult {
  PathReport path;
  std::vector<std::string> plenum_names;
  std::vector<std::string> chamber_names;
  std::vector<std::string> point_names;
  std::vector<std::string> plate_names;
  std::vector<std::vector<PointObservation>> observations;  ///< per point of the path, per named point
  /// Per point of the path, growth of the distance between the ends of the body along each axis (see BodyEnds), for a free body
  /// after its rotation is taken out; none for bodies without faces in all planes of their bounding box.
  std::vector<std::optional<Point>> extent_changes_m;
  std::vector<std::string> notes;  ///< what was assumed, what is doubtful, what could not be made
  std::size_t elements = 0;
  std::size_t unknowns = 0;
  double element_size_m = 0.0;      ///< cube root of the mean volume of an element
  std::size_t points_taken_up = 0;  ///< points of the path that an earlier run left
  double seconds = 0.0;             ///< wall time of this run
};

/// Runs a study and writes into `folder`: curves.csv (rewritten after every point of the path), fields.pvd with fields/,
/// chamber.png (see draw_deformed_body), pv_curve.png, result.toml (status, reason, limit points, counts) and manifest.json; and
/// path.checkpoint, with which the same study goes on where an earlier run was stopped. A study that has ended is not computed
/// again, and its fields and pictures stay where the output asks for none. Each file is written whole or not at all. Collective:
/// every rank of the communicator takes part, the first one writes.
/// @throws io::InputError on all ranks if the folder cannot be written, a checkpoint of another study lies in it and `restart` is
/// not given, or the study does not fit the body
InflationResult run_inflation(const InflationStudy& study, const std::filesystem::path& folder,
                              const InflationOptions& options = {});

}  // namespace menger::fem
