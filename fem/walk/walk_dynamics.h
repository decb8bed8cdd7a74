#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "fem/explicit/explicit_dynamics.h"
#include "fem/motion/implicit_state.h"
#include "fem/walk/walk_input.h"
#include "fem/walk/walk_result.h"

namespace menger::fem {

/// The state from which a walk can be resumed, one kind for each method.
using WalkState = std::variant<ExplicitState, ImplicitState>;

/// How a walk ended.
struct WalkOutcome {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};  ///< why it did not complete
};

/// Moves the body of a walk in time, by one of the methods. Nodes are those of the walk's mesh.
class WalkDynamics {
 public:
  WalkDynamics() = default;
  WalkDynamics(const WalkDynamics&) = delete;
  WalkDynamics& operator=(const WalkDynamics&) = delete;
  virtual ~WalkDynamics() = default;

  /// Advances to exactly this time; see ExplicitDynamics::advance_to.
  [[nodiscard]] virtual WalkOutcome advance_to(double time_s) = 0;

  /// Sets the state from which the walk continues. It must fit the body (asserts), see misfit.
  virtual void set_state(WalkState state) = 0;
  /// Returns why a state, such as one from a file, cannot be one of this body; empty if it can be. Only an element that is
  /// inverted may be left for set_state to find.
  [[nodiscard]] virtual std::string misfit(const WalkState& state) const = 0;
  [[nodiscard]] virtual WalkState state() const = 0;
  [[nodiscard]] virtual double time_s() const = 0;
  [[nodiscard]] virtual std::size_t steps() const = 0;

  /// Returns whether a walk that is resumed from any of its states gives the same results as an uninterrupted one. If not, this
  /// holds only for states that were passed to set_state: both must set them.
  [[nodiscard]] virtual bool goes_on_from_any_state() const = 0;

  /// Returns what results depend on besides the input: the instruction set, and for several processes their number.
  [[nodiscard]] virtual std::string machine_text() const = 0;

  /// Returns the record of the time that was reached.
  [[nodiscard]] virtual WalkRecord record() = 0;
  [[nodiscard]] virtual std::vector<double> displacements_m() const = 0;  ///< 3 per node
  [[nodiscard]] virtual std::vector<double> velocities_m_per_s() = 0;     ///< 3 per node
};

/// Makes the explicit dynamics of a walk, with the body at rest. Keeps nothing of the walk.
/// @param stop as in ExplicitOptions
/// @throws io::InputError if the dynamics reject the walk
std::unique_ptr<WalkDynamics> explicit_walk_dynamics(const PreparedWalk& walk, const std::atomic<bool>* stop);

}  // namespace menger::fem
