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

#include "evolution/evaluation/steady_displacement.h"
#include "io/text/run_status.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {

/// The result of evaluating one body at one level.
struct Evaluation {
  io::RunStatus status = io::RunStatus::stopped;

  /// Net displacement of the centre of mass (x, y, z) in metres, over the evaluation or the part of it that counts; of an
  /// evaluator that measures the last periods, the displacement in one of them (see steady_displacement_m). It exists exactly
  /// when the status is `completed`.
  std::optional<std::array<double, 3>> displacement_m;

  /// Net displacement over the evaluation that is not in displacement_m, in metres. It exists only if not all of the evaluation
  /// counts and the status is `completed`, or with all of the displacement if it is `fell`.
  std::optional<std::array<double, 3>> left_out_m{};

  /// Displacement in each whole period of the drive. Empty if the evaluator does not measure them, or the status is neither
  /// `completed` nor `fell`.
  PeriodDisplacements period_displacements_m{};

  /// Where the evaluator's model left its range of validity: sentences joined by "; ", empty if nowhere. A result outside of the
  /// range stands, but it is an extrapolation.
  std::string outside_validity;

  std::string reason;          ///< empty when completed, otherwise what went wrong, where and when
  std::uint64_t steps = 0;     ///< time steps done
  std::uint64_t elements = 0;  ///< finite elements of the body; 0 if it moves as voxels, or was refused
  std::string fidelity;        ///< how finely the body is divided, in the words of its model; empty for voxels
  double seconds = 0.0;        ///< wall time; bodies evaluated together have equal shares of it; never compared
};

/// One evaluation to make: a body, its level and its scenario.
struct EvaluationTask {
  meshes::Polycube body;  ///< the whole aggregate
  int level = 1;
  std::size_t scenario = 0;  ///< position among DesignEvaluator::scenarios()
};

/// Returns how many threads a worker may use now, >= 1: its own thread, and its share of the threads of workers that have run out
/// of work. The number changes, so an evaluator calls this repeatedly.
using ThreadsNow = std::function<int()>;

/// Evaluates bodies. This is the only interface between the search and the physics.
///
/// Implementations must be pure: the same body and level always give the same result, apart from `seconds`, from any thread.
class DesignEvaluator {
 public:
  virtual ~DesignEvaluator() = default;

  /// Evaluates a body. Thread-safe.
  /// @param body the whole aggregate of level `level`: 3^level cells per side, all voxels of equal size
  /// @param stop when set, the evaluation returns soon with status `stopped`
  [[nodiscard]] virtual Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const = 0;

  /// Evaluates several bodies together. Every result equals that of evaluate(), apart from `seconds`, whatever the number of
  /// threads. Thread-safe.
  ///
  /// This implementation evaluates one body after the other on one thread. Others may use more threads, or the lanes of a
  /// register.
  [[nodiscard]] virtual std::vector<Evaluation> evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                                  const std::atomic<bool>& stop, const ThreadsNow& threads) const;

  /// Divides tasks into groups that are evaluated together, for example in the lanes of one register.
  /// @param workers threads that share the groups, >= 1
  /// @return groups of indices into `tasks`, each index once; in this implementation every task is a group of its own
  [[nodiscard]] virtual std::vector<std::vector<std::size_t>> groups(std::span<const EvaluationTask> tasks, int workers) const;

  /// Returns everything that decides a result besides the body and the level, as canonical text. Equal text means equal results.
  [[nodiscard]] virtual std::string physics() const = 0;

  /// Returns physics() of each scenario in which bodies are evaluated; in this implementation there is one.
  [[nodiscard]] virtual std::vector<std::string> scenarios() const { return {physics()}; }

  /// Returns what people should know of the evaluations so far, a sentence; empty if nothing. It decides no result.
  [[nodiscard]] virtual std::string remark() const { return ""; }

  /// Returns the expected cost of one evaluation, in an arbitrary but consistent unit. It serves scheduling only.
  [[nodiscard]] virtual double cost(const meshes::Polycube& body, int level) const = 0;
};

}  // namespace menger::evolution
