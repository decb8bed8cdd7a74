#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "fem/explicit/explicit_dynamics.h"
#include "fem/locomotion/locomotion_result.h"
#include "fem/locomotion/locomotion_study.h"
#include "fem/motion/implicit_state.h"

namespace menger::fem {

/// The state from which a run can be resumed, one kind for each method.
using LocomotionState = std::variant<ExplicitState, ImplicitState>;

/// How the run of a study ended.
struct LocomotionOutcome {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};  ///< why it did not complete
};

/// Moves the body of a study in time, by one of the methods. Nodes are those of the study's mesh.
class LocomotionDynamics {
 public:
  LocomotionDynamics() = default;
  LocomotionDynamics(const LocomotionDynamics&) = delete;
  LocomotionDynamics& operator=(const LocomotionDynamics&) = delete;
  virtual ~LocomotionDynamics() = default;

  /// Advances to exactly this time; see ExplicitDynamics::advance_to.
  [[nodiscard]] virtual LocomotionOutcome advance_to(double time_s) = 0;

  /// Sets the state from which the run continues. It must be of this method (asserts).
  virtual void set_state(LocomotionState state) = 0;
  [[nodiscard]] virtual LocomotionState state() const = 0;
  [[nodiscard]] virtual double time_s() const = 0;
  [[nodiscard]] virtual std::size_t steps() const = 0;

  /// Returns whether a run that is resumed from any of its states gives the same results as an uninterrupted one. If not, this
  /// holds only for states that were passed to set_state: both runs must set them.
  [[nodiscard]] virtual bool goes_on_from_any_state() const = 0;

  /// Returns what results depend on besides the study: the instruction set, and for several processes their number.
  [[nodiscard]] virtual std::string machine_text() const = 0;

  /// Returns the record of the time that was reached.
  [[nodiscard]] virtual LocomotionRecord record() = 0;
  [[nodiscard]] virtual std::vector<double> displacements_m() const = 0;  ///< 3 per node
  [[nodiscard]] virtual std::vector<double> velocities_m_per_s() = 0;     ///< 3 per node
};

/// Makes the dynamics of a study, with the body at rest.
/// @param stop as in ExplicitOptions
/// @throws io::InputError if the dynamics reject the study
using LocomotionMaker =
    std::function<std::unique_ptr<LocomotionDynamics>(const LocomotionStudy& study, const std::atomic<bool>* stop)>;

/// Makes the dynamics of a study by explicit dynamics.
std::unique_ptr<LocomotionDynamics> make_explicit_locomotion(const LocomotionStudy& study, const std::atomic<bool>* stop);

}  // namespace menger::fem
