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

/// Options of a run that do not change its results (but `strict` may end it earlier).
struct InflationOptions {
  bool restart = false;  ///< start again instead of resuming from a checkpoint
  /// Reject the study or end the run in cases that otherwise give only a warning note, also for points of earlier runs.
  bool strict = false;
  const std::atomic<bool>* stop = nullptr;  ///< ends the run with status `stopped`; results so far are kept
  /// Called on the first rank before the path is followed, with the notes that are known by then. Those of the result begin with
  /// them.
  std::function<void(const std::vector<std::string>& notes)> begun{};
  /// Called on the first rank after every point of the path, with the parameters of its start and end.
  std::function<void(const PathPoint& point, double start_s, double end_s)> progress{};
  MPI_Comm communicator = MPI_COMM_WORLD;
};

/// The result of a run, the same on all ranks.
struct InflationResult {
  PathReport path;
  std::vector<std::string> plenum_names;
  std::vector<std::string> chamber_names;
  std::vector<std::string> point_names;
  std::vector<std::string> plate_names;
  std::vector<std::vector<PointObservation>> observations;  ///< per point of the path, per named point
  /// Per point of the path, the growth of the distance between the ends of the body along each axis (see BodyEnds). For a free
  /// body its rotation is removed first. Empty for bodies without faces in all planes of their bounding box.
  std::vector<std::optional<Point>> extent_changes_m;
  std::vector<std::string> notes;  ///< assumptions, doubts, and outputs that could not be made
  std::string linear_solver;       ///< the method for linear systems, and why: "direct: ..."
  std::size_t elements = 0;
  std::size_t unknowns = 0;
  double element_size_m = 0.0;     ///< cube root of the mean volume of an element
  std::size_t resumed_points = 0;  ///< points of the path that come from an earlier run
  double seconds = 0.0;            ///< wall time of this run
};

/// Runs a study and writes its results into `folder`: curves.csv (rewritten after every point of the path), fields.pvd with
/// fields/, chamber.png (see draw_deformed_body), pv_curve.png, displacement.png, result.toml (status, reason, limit points,
/// counts), manifest.json, and path.checkpoint.
///
/// From the checkpoint the same study resumes where an earlier run was stopped. A study that has ended is not computed again. Its
/// fields and pictures are kept if the output asks for none. Each file is written whole or not at all. Collective: every rank of
/// the communicator takes part, and the first one writes.
/// @throws io::InputError on all ranks if the folder cannot be written, if it holds a checkpoint of another study and `restart`
/// is not given, or if the study does not fit the body
InflationResult run_inflation(const InflationStudy& study, const std::filesystem::path& folder,
                              const InflationOptions& options = {});

}  // namespace menger::fem
