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

/// Where a run can be taken up, by the method that it was made with.
using LocomotionState = std::variant<ExplicitState, ImplicitState>;

/// How far the body of a study came.
struct LocomotionOutcome {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};  ///< in words, where it did not complete
};

/// The body of a study, moved on in time by one method or another. Nodes are those of the study's mesh.
class LocomotionDynamics {
 public:
  LocomotionDynamics() = default;
  LocomotionDynamics(const LocomotionDynamics&) = delete;
  LocomotionDynamics& operator=(const LocomotionDynamics&) = delete;
  virtual ~LocomotionDynamics() = default;

  /// To a time, exactly; see ExplicitDynamics::advance_to.
  [[nodiscard]] virtual LocomotionOutcome advance_to(double time_s) = 0;

  /// Goes on from a state of this method (asserts).
  virtual void set_state(LocomotionState state) = 0;
  [[nodiscard]] virtual LocomotionState state() const = 0;
  [[nodiscard]] virtual double time_s() const = 0;
  [[nodiscard]] virtual std::size_t steps() const = 0;

  /// Whether a run that is taken up from any state goes on as if nothing had happened. Otherwise only from one that the method
  /// was set to: both runs must set it.
  [[nodiscard]] virtual bool goes_on_from_any_state() const = 0;

  /// What decides about results beside the study: the instruction set.
  [[nodiscard]] virtual std::string machine_text() const = 0;

  /// Everything at the time that was reached.
  [[nodiscard]] virtual LocomotionRecord record() = 0;
  [[nodiscard]] virtual std::vector<double> displacements_m() const = 0;  ///< 3 per node
  [[nodiscard]] virtual std::vector<double> velocities_m_per_s() = 0;     ///< 3 per node
};

/// Makes the body of a study at rest. @param stop as in ExplicitOptions
/// @throws io::InputError if the dynamics refuse the study
using LocomotionMaker =
    std::function<std::unique_ptr<LocomotionDynamics>(const LocomotionStudy& study, const std::atomic<bool>* stop)>;

/// The maker for studies of explicit dynamics.
std::unique_ptr<LocomotionDynamics> make_explicit_locomotion(const LocomotionStudy& study, const std::atomic<bool>* stop);

}  // namespace menger::fem
