#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/reevaluation/reevaluation_table.h"
#include "evolution/reference/reevaluation_study.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// How designs are judged again, never what comes out of it.
struct ReevaluationOptions {
  std::filesystem::path programs;  ///< folder of menger-locomote
  int jobs = 1;                    ///< designs at the same time
  const std::atomic<bool>* stop = nullptr;
  bool pictures = true;

  /// @param done, total runs of finite elements @param name of one that is under way
  std::function<void(std::size_t done, std::size_t total, const std::string& name)> progress{};
};

/// What it gave.
struct ReevaluationResult {
  /// Or stopped; not_converged if no design completed in both models.
  io::RunStatus status = io::RunStatus::completed;
  ReevaluationFindings findings;
  std::vector<std::string> notes;
  std::size_t repeated = 0;  ///< runs of finite elements that were made by this call, not found from an earlier one
};

/// Judges designs of an archive by the locomotion of finite elements and, for the same body, pressure and time, by the surrogate,
/// adds what it finds to the archive and writes into a folder:
/// - reevaluation.csv, refused.csv, reevaluation_judge.csv (with variants), ranking.csv, summary.txt, reevaluation.png,
/// - trajectories/rank_<n>.csv: each design in both models on one clock,
/// - winner/: the design of the best rank as design.toml, trajectories.png, both.pvd and strip.png (see write_both_models),
/// - runs/: a folder per run of finite elements, by which a second call finds it.
///
/// A design that fails stands in the tables with its status; the others go on. Stopped, nothing is written but what is in runs/.
/// Surrogates are judged anew in every call. What is archived of a robot is of its standing body, under the name of what the
/// search simulated.
/// @param archive of the study, which is closed before its file is written to: so the file holds everything in the end, without a
/// log beside it
/// @throws io::InputError if no design can be judged (with the first reason), the program is missing or refuses every design,
/// another process writes to the archive, or a place cannot be written
ReevaluationResult reevaluate(const ReevaluationStudy& study, RunArchive archive, const std::filesystem::path& folder,
                              const ReevaluationOptions& options);

}  // namespace menger::evolution
