#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/workers.h"
#include "evolution/search/known_score.h"
#include "evolution/study/study.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// How robots of an archive walk again on finite elements.
struct WalksAgain {
  Study study;          ///< of finite elements; all its scenarios
  std::string variant;  ///< a name for display, see Reevaluation
};

/// How such walks are made. It does not change their results.
struct WalksAgainOptions {
  int threads = 1;  ///< >= 1, of this process if it has no other workers
  const std::atomic<bool>* stop = nullptr;
  std::function<void(std::size_t done, std::size_t total)> progress{};
  std::function<void(std::size_t count)> after_commit{};  ///< called when the archive has grown for the count-th time, from 1
  const Workers* workers = nullptr;                       ///< who evaluates; null: `threads` of this process
};

/// Returns the best designs of an archive that differ by more than their pose, the best first. @param study of the archive
std::vector<FitDesign> different_robots(const Study& study, const RunArchive& archive, std::size_t most);

/// Lets robots of an archive walk in all scenarios of studies. Results are re-evaluations of the archive; those that it has are
/// not made again.
/// @return completed or stopped
io::RunStatus walk_again(std::span<const WalksAgain> asked, std::span<const FitDesign> robots, RunArchive& archive,
                         const WalksAgainOptions& options);

/// Returns how many walks walk_again would make.
std::size_t missing_walk_count(const WalksAgain& asked, std::span<const FitDesign> robots, const RunArchive& archive);

/// The walks of this kind that an archive has.
class MadeWalks {
 public:
  explicit MadeWalks(const RunArchive& archive);

  [[nodiscard]] std::size_t count() const { return walks_.size(); }

  /// Returns the walks of a design in all scenarios; nothing if some are not there. @param protocols the physics of each
  /// @param design its hash at that level
  [[nodiscard]] std::optional<KnownResults> in_scenarios(const std::vector<std::string>& protocols, const std::string& design,
                                                         int level) const;

 private:
  std::map<std::tuple<std::string, int, std::string>, Evaluation> walks_;  ///< by design, level and protocol
};

/// Returns why the first scenario without a displacement failed; empty if all have one.
std::string first_reason(const KnownResults& results);

}  // namespace menger::evolution
