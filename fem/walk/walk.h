#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem/contact/body_overlap.h"
#include "fem/walk/walk_dynamics.h"
#include "fem/walk/walk_input.h"
#include "fem/walk/walk_result.h"
#include "meshes/load_cases/outermost_points.h"

namespace menger::fem {

/// Lets a body walk by explicit dynamics: from its input to its result, in memory alone.
///
/// Equal inputs give the same bytes on one instruction set: in any number of threads, and whatever other walks are made at the
/// same time. Thread-safe. At every record the body is checked for passing through itself (see BodyOverlapSearch), which ends the
/// walk as `diverged`.
/// @param stop when it becomes true, the walk returns as `stopped` with what it has, at the latest after the steps between two
/// estimates of the stable step (ExplicitOptions::steps_per_bound)
/// @throws WalkInputError naming the key for an input that cannot walk; io::InputError if the dynamics reject it
WalkResult walk(const WalkInput& input, const std::atomic<bool>* stop = nullptr);

/// How far a walk has come, and the state from which it can be resumed.
struct WalkProgress {
  WalkState state;
  std::vector<WalkRecord> records{};
  std::optional<WalkOutcome> outcome{};  ///< how it ended; empty while it is under way
  double seconds = 0.0;                  ///< wall time so far, as its keeper measures it
};

/// A walk that is made record by record, for callers that keep or show what happens in between.
class Walk {
 public:
  /// Keeps references to the walk and to the dynamics.
  /// @param dynamics of the walk, with its body at rest
  Walk(const PreparedWalk& walk, WalkDynamics& dynamics);

  /// Continues an earlier walk of the same input instead of beginning at rest.
  /// @throws io::InputError saying why the progress cannot be one of this walk. The walk then stays as it is, but for a state of
  /// implicit dynamics with an element inside out, after which it is of no use
  void resume(WalkProgress progress);

  /// Makes the record of the start, if there is none yet.
  /// @return whether there is a new record
  bool start();

  /// Goes on to the time of the next record. Precondition: it is under way.
  /// @return whether there is a new record. There is none if it was stopped, or if it failed at a time that has one.
  bool go_on();

  /// Whether the walk can go on: it has neither ended nor been stopped.
  [[nodiscard]] bool is_under_way() const { return result_.status == io::RunStatus::completed && !outcome_; }
  [[nodiscard]] bool is_stopped() const { return result_.status == io::RunStatus::stopped; }
  [[nodiscard]] const std::optional<WalkOutcome>& outcome() const { return outcome_; }

  [[nodiscard]] const std::vector<WalkRecord>& records() const { return result_.records; }
  [[nodiscard]] WalkDynamics& dynamics() const { return dynamics_; }

  /// Returns the state to resume from, without `seconds`. It can be some records ago, see
  /// WalkDynamics::goes_on_from_any_state.
  [[nodiscard]] WalkProgress progress() const;

  /// Returns the result so far. The status of a walk that is under way is `completed`.
  [[nodiscard]] WalkResult result() const;

 private:
  [[nodiscard]] WalkOutcome checked(WalkOutcome outcome) const;
  [[nodiscard]] std::string misfit(const WalkProgress& progress) const;
  void add_record();
  void make_restart_point();

  WalkDynamics& dynamics_;
  BodyOverlapSearch overlaps_;
  meshes::OutermostPoints outermost_;
  std::vector<double> times_s_;  ///< of all records but that of the start
  std::size_t plena_;
  std::size_t chambers_;
  WalkResult result_;  ///< without the time and steps reached
  std::optional<WalkOutcome> outcome_;
  std::optional<WalkState> restart_;  ///< of the last restart point, if the method needs them
  std::size_t restart_records_ = 0;   ///< records up to it
};

}  // namespace menger::fem
