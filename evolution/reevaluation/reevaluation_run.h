#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/reevaluation/reevaluation_table.h"
#include "evolution/reference/reevaluation_runner.h"
#include "evolution/reference/reevaluation_study.h"
#include "io/ranks/rank_session.h"
#include "io/ranks/rank_team.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// Makes the walk of a job as kept_walk does, with frames if its study has them. @param folder not empty if it has them
fem::LocomotionResult walk_with_frames(const LocomotionJob& job, const std::filesystem::path& folder,
                                       const std::atomic<bool>& stop);

/// Options that decide how designs are evaluated again. They do not change the results.
struct ReevaluationOptions {
  int jobs = 1;  ///< number of designs at the same time
  const std::atomic<bool>* stop = nullptr;
  bool pictures = true;
  Walker walker = walk_with_frames;  ///< makes the walks on finite elements

  io::RankSession* ranks = nullptr;  ///< that make the walks on finite elements together; null: this process alone
  double rank_patience_s = io::TeamOptions{}.patience_s;  ///< see io::TeamOptions
  std::function<void(const std::string&)> note{};         ///< see io::TeamOptions

  /// Called during the runs. @param done, total numbers of runs of finite elements @param name a run that is being made
  std::function<void(std::size_t done, std::size_t total, const std::string& name)> progress{};
};

/// The result of a re-evaluation.
struct ReevaluationResult {
  /// completed, stopped, or not_converged if no design completed in both models.
  io::RunStatus status = io::RunStatus::completed;
  ReevaluationFindings findings;
  std::vector<std::string> notes;
  std::size_t repeated = 0;  ///< number of runs of finite elements made in this call, not found from an earlier one
};

/// Evaluates designs of an archive again by locomotion on finite elements, and by the surrogate for the same body, pressure and
/// time. Adds the results of the finite elements to the archive and writes into a folder:
/// - reevaluation.csv, refused.csv, variants.csv (with variants), ranking.csv, summary.txt, reevaluation.png,
/// - trajectories/rank_<n>.csv: each design in both models at the same times,
/// - winner/: the design of the best rank as design.toml, trajectories.png, both.pvd and strip.png (see write_both_models). If
///   the search confirmed its robots on finer elements, the one that it is shown by (best_confirmed) takes this place,
/// - runs/: a folder per run of finite elements, where a second call finds it.
///
/// A design that fails is in the tables with its status, and the others go on. If the user stops it, only runs/ is written.
/// Surrogates are evaluated again in every call. The archived result of a robot is that of its standing body, with the design
/// hash of the body that the search simulated.
/// @param archive that of the study; it is closed before its file is written to, so that in the end the file has everything,
/// without a log beside it
/// @throws io::InputError if no design can be evaluated (with the first reason), finite elements refuse every design,
/// another process writes to the archive, or a file cannot be written
ReevaluationResult reevaluate(const ReevaluationStudy& study, RunArchive archive, const std::filesystem::path& folder,
                              const ReevaluationOptions& options);

/// Makes walks on finite elements for the first rank, which is in reevaluate() with equal arguments, until there are no more.
/// @throws io::InputError as reevaluate() does, before it makes any
void walk_for_first_rank(const ReevaluationStudy& study, RunArchive archive, const std::filesystem::path& folder,
                         const ReevaluationOptions& options);

}  // namespace menger::evolution
