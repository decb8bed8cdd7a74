#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "evolution/evaluation/evaluator.h"
#include "evolution/study/study.h"
#include "fem/walk/walk.h"

namespace menger::evolution {

/// A walk of a search that is made in parts. It gives the same result as fem::walk, wherever it pauses.
class WalkInParts {
 public:
  /// @throws io::InputError for a body that cannot walk
  explicit WalkInParts(const fem::WalkInput& input);

  /// Goes on to a time, or to the end of the walk if that comes first.
  /// @return false if it was stopped before
  bool go_on_to(double time_s, const std::atomic<bool>& stop);

  /// Returns the result so far. The status of a walk that is under way is `completed`.
  [[nodiscard]] fem::WalkResult result() const { return walk_.result(); }

 private:
  fem::PreparedWalk prepared_;
  std::unique_ptr<fem::WalkDynamics> dynamics_;
  fem::Walk walk_;
};

/// Walks that pause after their first half, until it is known which of them go on. It only saves time: a walk that is not here is
/// made from its start, with the same result. Thread-safe.
class PausedWalks {
 public:
  /// @param most walks that are kept, >= 1; beyond that the oldest is dropped
  explicit PausedWalks(std::size_t most) : most_(most) {}

  void put(const meshes::Polycube& body, std::unique_ptr<WalkInParts> walk);

  /// Returns a walk and forgets it; null if there is none.
  [[nodiscard]] std::unique_ptr<WalkInParts> take(const meshes::Polycube& body);

 private:
  std::size_t most_;
  std::mutex access_;
  std::map<std::string, std::unique_ptr<WalkInParts>> walks_;  ///< by body
  std::deque<std::string> order_;                              ///< of their bodies, the oldest first
};

/// Returns a study of finite elements of which each walk ends with the first half of its whole periods. It measures the last
/// periods, as the whole study, as far as there are so many beside the first one. Precondition: the study measures the last
/// periods, and has four whole periods.
Study first_half_of(const Study& study);

/// Evaluates the first halves of walks on finite elements: the result is that of a study whose walks are so short.
class HalfWalkEvaluator final : public DesignEvaluator {
 public:
  /// @param study of the whole walks, see first_half_of
  /// @param paused gets the walks, so that they can go on; may be null
  HalfWalkEvaluator(Study study, std::shared_ptr<PausedWalks> paused);

  /// Precondition: level 1.
  [[nodiscard]] Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const override;
  [[nodiscard]] std::string physics() const override;
  [[nodiscard]] double cost(const meshes::Polycube& body, int level) const override;

 private:
  Study whole_;
  Study half_;
  std::shared_ptr<PausedWalks> paused_;
};

}  // namespace menger::evolution
