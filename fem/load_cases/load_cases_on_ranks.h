#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fem/load_cases/load_case_study.h"
#include "io/ranks/rank_session.h"
#include "io/ranks/rank_team.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// A set of load cases that the ranks of mpirun compute together, each case by a program of its own: PETSc does one thing at a
/// time in a process. All ranks see the same files.
struct RankedLoadCases {
  std::filesystem::path program;       ///< menger-load-cases
  std::filesystem::path set;           ///< file of the set
  std::filesystem::path folder;        ///< of the curves; responses are found again in its cache
  std::vector<std::string> options{};  ///< further arguments of the program, which decide what is kept of a case
  std::vector<CaseRequest> cases{};    ///< of the set, those to compute
  StudyMaterial material{};            ///< of the set

  /// Whether fields are kept. Then no two ranks compute a case at the same time, since they would publish its fields in one
  /// folder: a rank that gets the case of one that is only slow waits for it.
  [[nodiscard]] bool has_fields() const { return std::ranges::find(options, "--fields") != options.end(); }
};

/// Returns the number that says how costly a case is in comparison with others of its set: cells times states.
double expected_cost(const CaseRequest& request);

/// Computes all cases, the costliest first, so that their responses are in the cache. To be called by the first rank.
/// @param finished called after every case, with the number of those that are done
/// @return completed, or stopped
/// @throws io::InputError naming the case if its program refuses it, and as io::call_roll does
io::RunStatus compute_on_ranks(const RankedLoadCases& set, io::RankSession& ranks, const io::TeamOptions& options,
                               const std::atomic<bool>* stop, const std::function<void(std::size_t done)>& finished);

/// Computes cases for the first rank, which is in compute_on_ranks with an equal set. To be called by every other rank.
void compute_for_first_rank(const RankedLoadCases& set, io::RankSession& ranks, const io::TeamOptions& options);

/// Lets the program do the whole set, whose responses are in the cache: it writes all curves, pictures and the manifest, and
/// prints what it prints alone. @return its exit code
int finish_set(const RankedLoadCases& set, const std::atomic<bool>* stop);

}  // namespace menger::fem
