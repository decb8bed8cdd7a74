#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fem/explicit/explicit_elements.h"
#include "fem/motion/motion_energy.h"
#include "fem/surfaces/point.h"

namespace menger::fem {

/// Equal steps that a body is to take. Until the free travel is used up nothing can touch.
struct StepsOrder {
  double first_kick_s = 0.0;  ///< of the first step: the mean of the step before and this one
  double step_s = 0.0;
  std::size_t count = 0;
  double branch_age_s = 0.0;           ///< see BranchState
  double relaxation_interval_s = 0.0;  ///< time between two relaxations of branches; 0: there are none
  Point common_velocity_m_per_s{};     ///< travel is relative to it
  double free_travel_m = 0.0;          ///< ends after the step in which the travels of all steps reach this
  /// Of all plena, Pa: at the step before, at each of the steps, and at the one that would follow.
  std::vector<double> pressures_Pa{};
};

/// What a body's steps came to.
struct StepsOutcome {
  std::size_t steps = 0;      ///< taken, at most those of the order
  bool has_failed = false;    ///< an element has, at the place that the steps before it have led to
  double travel_m = 0.0;      ///< the largest displacement of a node in each step, added up
  double branch_age_s = 0.0;  ///< at the end
  MotionWork work{};          ///< without that of the change of pressure in the first step, see ExplicitDynamics
  PressedVolumes volumes{};   ///< at the last step
};

/// Where a body is and how it moves, as in ExplicitState; changed by the steps.
struct SteppedBody {
  std::vector<double>& displacements_m;
  std::vector<double>& velocities_m_per_s;
  BranchNumbers& branches;
};

/// Takes steps of a body in place of the processor, such as on a graphics processor. The body has no contact with itself
/// meanwhile. Deterministic: equal states and orders give equal bytes.
class StepTaker {
 public:
  StepTaker() = default;
  StepTaker(const StepTaker&) = delete;
  StepTaker& operator=(const StepTaker&) = delete;
  virtual ~StepTaker() = default;

  /// Returns what takes the steps, with its number type; results depend on it.
  [[nodiscard]] virtual std::string text() const = 0;

  [[nodiscard]] virtual StepsOutcome take(const StepsOrder& order, const SteppedBody& body) = 0;
};

}  // namespace menger::fem
