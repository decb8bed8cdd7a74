#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {

/// What judging one body at one level gave.
struct Evaluation {
  io::RunStatus status = io::RunStatus::stopped;

  /// Net displacement of the centre of mass (x, y, z) in metres over the evaluation, or the part of it that counts; exists
  /// exactly when status is `completed`.
  std::optional<std::array<double, 3>> displacement_m;

  /// Displacement before the part of the evaluation that counts, in metres; only where that does not begin at the start, and the
  /// status is `completed`.
  std::optional<std::array<double, 3>> left_out_m{};

  /// Where the judge's model left the range that it is known to hold in, sentences joined by "; "; empty: nowhere. The result
  /// stands, but it is an extrapolation.
  std::string outside_validity;

  std::string reason;       ///< empty when completed, otherwise what went wrong, where and when
  std::uint64_t steps = 0;  ///< time steps done
  double seconds = 0.0;     ///< wall time, of bodies judged together an equal share of it; never compared
};

/// A body to be judged at a level.
struct EvaluationTask {
  meshes::Polycube body;  ///< the whole aggregate
  int level = 1;
};

/// How many threads may work on what a worker judges, now: its own, and its part of those that have run out of work. Asked again
/// and again, since that changes. >= 1
using ThreadsNow = std::function<int()>;

/// Judges bodies. The search knows nothing else of the physics behind it.
///
/// Implementations must be pure: the same body and level give the same result apart from `seconds`, from any thread, any number
/// of times.
class DesignEvaluator {
 public:
  virtual ~DesignEvaluator() = default;

  /// Judges a body of level `level` (3^level cells per side; `body` is the whole aggregate, its cells are voxels of equal size).
  /// Thread-safe. @param stop when set, the evaluation returns soon with status `stopped`
  [[nodiscard]] virtual Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const = 0;

  /// Judges several bodies at a time: every result is the one of evaluate, `seconds` apart. Thread-safe; one after the other
  /// unless an implementation knows better, and by one thread unless it can use more. No result depends on the threads.
  [[nodiscard]] virtual std::vector<Evaluation> evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                                  const std::atomic<bool>& stop, const ThreadsNow& threads) const;

  /// Divides tasks into groups that are evaluated together, for example in the lanes of one register.
  /// @param workers threads that groups are shared among, >= 1
  /// @return groups of indices into `tasks`, each index once; every task alone unless an implementation overrides this
  [[nodiscard]] virtual std::vector<std::vector<std::size_t>> groups(std::span<const EvaluationTask> tasks, int workers) const;

  /// All that decides a result beside the body and the level, as canonical text: equal text means equal results.
  [[nodiscard]] virtual std::string physics() const = 0;

  /// Expected cost of one evaluation in arbitrary but consistent units, for scheduling only.
  [[nodiscard]] virtual double cost(const meshes::Polycube& body, int level) const = 0;
};

}  // namespace menger::evolution
