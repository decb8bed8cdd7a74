#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fem/contact/block_loop.h"
#include "fem/contact/self_contact.h"
#include "fem/explicit/explicit_body.h"
#include "fem/explicit/explicit_chambers.h"
#include "fem/explicit/explicit_nodes.h"
#include "fem/explicit/stable_step.h"
#include "fem/explicit/step_taker.h"
#include "fem/motion/motion_energy.h"
#include "fem/pneumatics/pneumatic_integrator.h"
#include "fem/pneumatics/pneumatic_supply.h"
#include "fem/pneumatics/pressure_schedule.h"
#include "io/text/input_error.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// Settings of explicit dynamics.
struct ExplicitOptions {
  NodalLoads loads;
  std::vector<PlenumSchedule> schedules;    ///< one per plenum; empty: no pressure, or the supply
  std::optional<PneumaticSupply> supply{};  ///< of all plena, instead of schedules
  double step_safety = 0.8;                 ///< step over the stable step, in (0, 1]
  std::optional<double> largest_step_s{};   ///< > 0; for studies of the step
  std::size_t steps_per_bound = 1000;       ///< largest number of steps between two estimates of the stable step, >= 1
  /// > 0: largest imbalance of the energy over the largest turnover so far. Beyond it steps are shortened, and if that does not
  /// help the run ends as `diverged`.
  double largest_imbalance = 0.2;
  /// Largest volume of a chamber over its volume at rest; beyond it the run ends as `diverged`.
  double largest_volume_ratio = 20.0;
  /// Smallest stable step over that at rest; below it the run ends as `diverged`.
  double smallest_step_ratio = 0.02;
  std::optional<SelfContactLaw> self_contact = SelfContactLaw{};  ///< empty: walls that touch end the run
  int threads = 1;                                                ///< >= 1; results do not depend on it
  /// Takes steps in place of this processor while nothing can touch; empty: none. Checks and contact stay here. It is of this
  /// body and of these loads, and the supply has no lines. A state that is set then continues as before up to rounding only.
  std::shared_ptr<StepTaker> step_taker{};
  const std::atomic<bool>* stop = nullptr;  ///< ends a run as `stopped` when it becomes true
};

/// The state of the Maxwell branches of a body's materials.
struct BranchState {
  BranchNumbers numbers;
  double age_s = 0.0;  ///< time since they last relaxed

  bool operator==(const BranchState&) const = default;
};

/// The state of a moving body; component i of node a at 3 a + i.
struct ExplicitState {
  double time_s = 0.0;
  std::vector<double> displacements_m;     ///< at time_s
  std::vector<double> velocities_m_per_s;  ///< half a step before time_s
  double last_step_s = 0.0;                ///< 0 at the start, where velocities are those at time_s
  std::size_t steps = 0;
  std::size_t steps_to_bound = 25;    ///< number of steps between two estimates of the stable step
  std::size_t steps_since_bound = 0;  ///< number of steps since the last one
  double stable_step_s = 0.0;         ///< the last estimate; 0: none yet
  /// Factor on the step, at most 1; reduced after steps that had to be repeated.
  double step_share = 1.0;
  /// Up to the time of the velocities. The work of pressure is here that of its changes alone, and that of the weight is left
  /// out: their energies are known at every time.
  MotionWork work;
  /// See MotionEnergies; empty: the energy balance begins with this state.
  std::optional<double> at_start_J{};
  double turnover_J = 0.0;  ///< largest so far, see MotionEnergies
  /// Of the supply in the options, at time_s; empty: the supply starts with this state.
  std::optional<PneumaticState> pneumatics{};
  /// The memory of self-contact before the last step. Empty: every contact in this state presses with its full depth.
  std::optional<std::vector<ContactMemory>> contact{};
  std::optional<BranchState> branches{};  ///< empty: they are at rest in this state
  /// The pressures in the plena at the last step, Pa, and the changes of volume then. Empty: those of this state.
  std::vector<double> pressures_Pa{};
  PressedVolumes pressed_volumes{};
};

/// How a run ended.
struct ExplicitReport {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason;                           ///< why the run did not complete
  std::optional<std::size_t> failed_element{};  ///< of the mesh
};

/// Thrown if a branch of the material relaxes faster than the steps of the body can resolve.
class UnresolvedRelaxation : public io::InputError {
  using io::InputError::InputError;
};

/// Moves a body in time by central differences with lumped masses. All results are the same bytes for any number of threads.
///
/// Maxwell branches relax separately from the steps: by the exact exponential at fixed deformation, whenever 0.08 of the shortest
/// relaxation time has passed. In between they act as springs. Their loss is the decrease of their energy and is
/// never negative, so that the energy balance closes as well as that of an elastic body. For motion that is slow against the time
/// between two relaxations, the branches are accurate to second order in that time, because their tensors stand for its middle.
///
/// Time advances in intervals of equal steps, at most `steps_per_bound`. The state is checked at the end of each interval:
/// - The energy balance must close.
/// - The stable step there must not be below the step that was taken. It is estimated anew after
///   `steps_to_bound` steps, which may be several intervals.
/// - No part of the surface may have penetrated another one more deeply than contact detects with certainty.
/// - No part of the surface near another one may have moved further in a step than contact detects with certainty.
///
/// If a check fails, the interval is repeated from a copy of its start, with half as many steps of half the length. This goes on
/// until the checks pass or the step falls below its smallest ratio. Estimates of the stable step get rarer where it
/// changes from one to the next by at most a quarter of the distance that steps keep from it, 1 - `step_safety` (5 % by default),
/// and more frequent where it changes more.
///
/// The energy balance is taken at one time. The energy of modes whose period is only a few steps is known only roughly, to the
/// square of step times frequency. A body that mostly moves in such modes gets shorter steps because of it.
///
/// Parts of the outside that meet, and walls of one chamber, push each other and rub (see SelfContact). Chamber pressure acts on
/// walls that touch as on all others. While nothing touches, results are the same bytes with and without self-contact, unless
/// near parts move a twentieth of an edge in a step. Without self-contact, walls that touch end the run as `wall_contact`, and
/// parts of the outside pass through each other. In both cases a chamber that has no volume left ends the run as `wall_contact`.
class ExplicitDynamics {
 public:
  /// Starts with the body at rest in its reference configuration. Keeps a reference to the body.
  /// @throws io::InputError for options outside their ranges, for schedules beside a supply, if the number of schedules is not
  /// that of the mesh's plena, and for schedules that the first step cannot resolve
  /// @throws UnresolvedRelaxation if a branch relaxes so fast that it would shorten the steps to less than a tenth
  ExplicitDynamics(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, ExplicitOptions options);

  ExplicitDynamics(const ExplicitDynamics&) = delete;
  ExplicitDynamics& operator=(const ExplicitDynamics&) = delete;

  /// Sets the state from which the run continues. A state that was returned before continues as if the run had not been
  /// interrupted.
  ///
  /// A state that was changed must leave some members empty: `at_start_J` always, since otherwise the energy balance is off by
  /// the change, and `stable_step_s` zero; `pneumatics` if the time or volumes of chambers changed; `contact` if displacements or
  /// velocities changed. `branches` may be empty. Velocities of held components become zero. Sizes must fit (asserts).
  /// @throws io::InputError naming an element that is inverted or not finite there
  void set_state(ExplicitState state);
  [[nodiscard]] const ExplicitState& state() const { return state_; }

  /// Returns why a state, such as one from a file, cannot be one of this body: the first of its members that does not fit, or an
  /// element that is inverted. Empty if it can be.
  [[nodiscard]] std::string misfit(const ExplicitState& state) const;

  /// Advances to this time. The end of each call is the end of an interval. If a run does not complete, its state is the last one
  /// that passed the checks (for a contact or a volume that ended it, the state where that was found), and further calls return
  /// the same report.
  [[nodiscard]] const ExplicitReport& advance_to(double time_s);

  [[nodiscard]] const ExplicitBody& body() const { return body_; }
  [[nodiscard]] std::vector<double> positions_m() const;
  [[nodiscard]] std::vector<double> velocities_m_per_s();  ///< at the time of the state
  [[nodiscard]] std::vector<double> chamber_volumes_m3() const { return chambers_.volumes_m3(positions_m()); }
  [[nodiscard]] std::vector<double> plenum_volumes_m3() const;
  [[nodiscard]] double plenum_pressure_Pa(std::size_t plenum) const;
  [[nodiscard]] MotionEnergies energies();
  [[nodiscard]] double ground_force_N() const;          ///< upwards on the body
  [[nodiscard]] std::vector<SelfTouch> self_touches();  ///< none without self-contact
  [[nodiscard]] Point centre_of_mass_m() const;

 private:
  struct HalfStep {
    std::vector<double> velocities;
    MotionWork work;
  };
  void check(const meshes::HexahedralMesh& mesh) const;
  /// Returns the stable step of the state, with the contacts found last.
  [[nodiscard]] double stable_step();
  [[nodiscard]] double longest_step_s() const;
  void pass_interval(double time_s);
  std::optional<ExplicitReport> take_steps(double step_s, std::size_t count, double end_s);
  [[nodiscard]] bool may_leave_steps(double step_s);
  [[nodiscard]] StepsOutcome leave_steps(double step_s, std::size_t count);
  std::optional<ExplicitReport> check();
  void accept(double last_stable_step_s);
  [[nodiscard]] std::optional<ExplicitReport> check_contact() const;
  [[nodiscard]] bool walls_have_met() const;
  void look_at_chambers();
  bool take_step(double step_s);
  [[nodiscard]] PneumaticReport supply_air();
  [[nodiscard]] double due_relaxation_s(double step_s) const;
  bool compute_forces(double relaxed_s = 0.0);
  void set_pressures();
  void add_work_of_pressure_changes(MotionWork& work) const;
  void find_touches();
  void set_current_positions();
  void set_followed_positions();
  void set_touched_blocks();
  NodesOutcome move(const StepTimes& times, std::vector<double>& displacements, std::vector<double>& velocities,
                    ElementForces* followers = nullptr);
  HalfStep half_step();
  [[nodiscard]] MotionEnergies energies_since_start();
  [[nodiscard]] double largest_speed_m_per_s() const;
  [[nodiscard]] Point mean_velocity_m_per_s() const;
  [[nodiscard]] ExplicitReport failure(io::RunStatus status, const std::string& reason) const;
  [[nodiscard]] ExplicitReport failure_in_element() const;

  const ExplicitBody& body_;
  ExplicitOptions options_;
  ExplicitChambers chambers_;
  /// Only between walls of chambers, and without forces, if the options have no self-contact.
  SelfContact self_contact_;
  std::vector<double> areas_;
  std::vector<double> ground_springs_;  ///< N/m per component, as if every node of the outside touched the ground
  NodeUpdate nodes_;
  BlockLoop loop_;
  std::optional<PneumaticIntegrator> air_;  ///< where there are lines
  ExplicitState state_;
  ExplicitState last_good_;
  ExplicitReport report_;
  double rest_stable_step_ = 0.0;
  double energy_noise_ = 0.0;  ///< J, negligible in the energy balance
  std::optional<double> relaxation_interval_s_;
  Point common_velocity_{};              ///< of the centre of mass at the start of an interval
  double interval_speed_m_per_s_ = 0.0;  ///< of the fastest node then, relative to it
  std::size_t next_leave_ = 0;           ///< number of steps before which none are left to another one
  std::vector<double> first_volumes_;
  std::vector<double> pressures_Pa_;  ///< in the plena, at the time of the last forces
  PressedVolumes pressed_volumes_;    ///< at the time of the last forces
  std::vector<double> first_plenum_volumes_m3_;
  std::vector<double> face_volumes_m3_;  ///< see ExplicitChambers::set_face_forces
  std::vector<double> clearances_m_;     ///< see NodeUpdate
  std::vector<char> touched_blocks_;     ///< see BodyForces
  std::vector<double> current_positions_;
  std::unique_ptr<ElementForces> element_forces_;
  std::optional<EigenvalueEstimate> eigenvalues_;
  AlignedNumbers chamber_slots_;
  std::vector<ForcesOutcome> outcomes_;
  bool elements_follow_ = false;     ///< whether the elements know the places of the state
  bool has_failed_element_ = false;  ///< at the time of the forces that were computed last
  std::vector<NodesOutcome> moves_;
  std::optional<MotionEnergies> energies_;  ///< of the state, if they are known; with at_start_J = 0
};

/// Advances to each of the times (increasing) and calls `observe` at the start and at each of them. Ends where a run does not
/// complete.
const ExplicitReport& follow(ExplicitDynamics& dynamics, const std::vector<double>& times_s,
                             const std::function<void(ExplicitDynamics&)>& observe);

}  // namespace menger::fem
