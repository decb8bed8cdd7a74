#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fem/contact/block_loop.h"
#include "fem/contact/self_contact.h"
#include "fem/explicit/explicit_body.h"
#include "fem/explicit/explicit_chambers.h"
#include "fem/explicit/explicit_nodes.h"
#include "fem/explicit/explicit_step_bound.h"
#include "fem/motion/explicit_energy.h"
#include "fem/pneumatics/pneumatic_integrator.h"
#include "fem/pneumatics/pneumatic_supply.h"
#include "fem/pneumatics/pressure_schedule.h"
#include "io/text/input_error.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// How a body is moved on in time.
struct ExplicitOptions {
  NodalLoads loads;
  std::vector<PlenumSchedule> schedules;    ///< one per plenum; empty: no pressure, or that of the supply
  std::optional<PneumaticSupply> supply{};  ///< of all plena, in place of schedules
  double step_safety = 0.9;                 ///< part of the stable step that is used, in (0, 1]
  std::optional<double> largest_step_s{};   ///< > 0; for studies of the step
  std::size_t steps_per_bound = 500;        ///< at most, after which an interval is judged, >= 1
  double largest_imbalance = 0.2;           ///< > 0, of the largest turnover so far; more and the books are open: diverged
  double largest_volume_ratio = 20.0;       ///< of a chamber to its start; beyond it has run away: diverged
  double smallest_step_ratio = 0.02;        ///< of the stable step to that at rest; below it the body has diverged
  std::optional<SelfContactLaw> self_contact = SelfContactLaw{};  ///< nothing: walls that touch end the run
  int threads = 1;                                                ///< >= 1; results do not depend on it
  const std::atomic<bool>* stop = nullptr;                        ///< ends a run as `stopped` when it becomes true
};

/// Where the branches of a body's materials are.
struct BranchState {
  AlignedNumbers tensors;  ///< of all batches, see BranchTensors; empty without branches. Laid out for one width of kernels
  double age_s = 0.0;      ///< since they relaxed

  bool operator==(const BranchState&) const = default;
};

/// Where a body is and how it moves; component i of node a at 3 a + i.
struct ExplicitState {
  double time_s = 0.0;
  std::vector<double> displacements_m;     ///< at time_s
  std::vector<double> velocities_m_per_s;  ///< half a step before
  double last_step_s = 0.0;                ///< 0 at the start: velocities are those at time_s
  std::size_t steps = 0;
  std::size_t steps_to_bound = 25;             ///< of the next interval
  double step_share = 1.0;                     ///< of the stable step, less after steps that had to be taken again
  ExplicitWork work;                           ///< up to the velocities' time
  std::optional<double> at_start_J{};          ///< see ExplicitEnergies; nothing: the books begin with this state
  double turnover_J = 0.0;                     ///< largest so far
  std::optional<PneumaticState> pneumatics{};  ///< at time_s, of the options' supply; nothing: it starts with this state
  /// Of contact of the body with itself, before the last step; nothing: what touches in this state is pressed by all of its
  /// depth.
  std::optional<std::vector<ContactMemory>> contact{};
  std::optional<BranchState> branches{};  ///< nothing: they are at rest in this state
};

/// How far a run came.
struct ExplicitReport {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason;                           ///< in words, where it did not complete
  std::optional<std::size_t> failed_element{};  ///< of the mesh
};

/// A branch of the material relaxes faster than steps of the body can follow.
class UnresolvedRelaxation : public io::InputError {
  using io::InputError::InputError;
};

/// Central differences with lumped masses. Bytes of all results are the same for any number of threads.
///
/// Maxwell branches relax by themselves, at a held deformation and by the exact exponential, every few steps: whenever a
/// twenty-fifth of the shortest relaxation time has passed. In between they are springs. What they lose is what their energy
/// falls by, never negative, so that the books close as well as those of an elastic body. Motion that is slow against the time
/// between gets its branches to second order in it (their tensors stand for the middle of that time).
///
/// Time goes on in intervals of equal steps, at most `steps_per_bound`. At the end of each the state is judged: the stable step
/// there must not be below the step that was taken, the energy books must close, and parts of the surface must not have been
/// deeper in each other, nor have moved further in a step while they were near, than is certain to be seen. Otherwise the
/// interval is taken again from a copy of its start, with half as many steps of half the length, until it passes or the step
/// falls below its smallest ratio. Intervals get longer where the stable step changes little (2 % in one), and shorter where it
/// changes more.
///
/// The books count energy at one time: that of modes whose period is a few steps is known only roughly (to the square of step
/// times frequency), and a body that mostly moves in such modes gets shorter steps for it.
///
/// Parts of the outside that meet, and walls of one chamber, push each other and rub (see SelfContact); chamber pressure
/// acts on walls that touch as on all others. While nothing touches, results are the same bytes with and without, unless near
/// parts move a twentieth of an edge in a step. Without self-contact, walls that touch end the run as `wall_contact`, and parts
/// of the outside pass through each other; a chamber that has no volume left ends it so, too, with and without.
class ExplicitDynamics {
 public:
  /// The body at rest in its reference configuration. Keeps references to the body.
  /// @throws io::InputError for options outside their ranges, as many schedules as the mesh has not plena, and schedules that the
  /// first step cannot resolve; UnresolvedRelaxation
  ExplicitDynamics(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, ExplicitOptions options);

  ExplicitDynamics(const ExplicitDynamics&) = delete;
  ExplicitDynamics& operator=(const ExplicitDynamics&) = delete;

  /// Another start: a state from before, to go on from as if nothing had happened, or one that was changed; then its
  /// `at_start_J` must be empty, or the books stay open by the change, and so must be `pneumatics` where time or chambers'
  /// volumes changed, and `contact` where displacements or velocities did; `branches` may be. Velocities of what is held become
  /// zero. Sizes must fit (asserts).
  /// @throws io::InputError naming an element that is inside out there or not finite
  void set_state(ExplicitState state);
  [[nodiscard]] const ExplicitState& state() const { return state_; }

  /// To a time; the end of each call is the end of an interval. Once a run has not completed, the state is the last one that was
  /// judged good (that of the contact or of the volume that ended it), and further calls return the same report.
  [[nodiscard]] const ExplicitReport& advance_to(double time_s);

  [[nodiscard]] const ExplicitBody& body() const { return body_; }
  [[nodiscard]] std::vector<double> positions_m() const;
  [[nodiscard]] std::vector<double> velocities_m_per_s();  ///< at the time of the state
  [[nodiscard]] std::vector<double> chamber_volumes_m3() const { return chambers_.volumes_m3(positions_m()); }
  [[nodiscard]] std::vector<double> plenum_volumes_m3() const;
  [[nodiscard]] double plenum_pressure_Pa(std::size_t plenum) const;
  [[nodiscard]] ExplicitEnergies energies();
  [[nodiscard]] double ground_force_N() const;          ///< upwards on the body
  [[nodiscard]] std::vector<SelfTouch> self_touches();  ///< none without self-contact
  [[nodiscard]] Point centre_of_mass_m() const;

 private:
  struct HalfStep {
    std::vector<double> velocities;
    ExplicitWork work;
  };
  void check(const meshes::HexahedralMesh& mesh) const;
  /// With the touches found last. @param branch tensors of all batches
  [[nodiscard]] double stable_step_at(std::span<const double> displacements_m, std::span<const double> branch) const;
  void pass_interval(double time_s);
  std::optional<ExplicitReport> take_steps(double step_s, std::size_t count, double end_s);
  std::optional<ExplicitReport> judge();
  void accept(double last_stable_step_s, std::size_t count);
  [[nodiscard]] std::optional<ExplicitReport> judge_contact() const;
  [[nodiscard]] bool walls_have_met() const;
  void look_at_chambers();
  bool take_step(double step_s);
  [[nodiscard]] PneumaticReport supply_air();
  [[nodiscard]] double due_relaxation_s(double step_s) const;
  double compute_forces(double relaxed_s = 0.0);
  void find_touches();
  void set_current_positions();
  NodesOutcome move(const StepTimes& times, std::vector<double>& displacements, std::vector<double>& velocities);
  HalfStep half_step();
  [[nodiscard]] Point mean_velocity_m_per_s() const;
  [[nodiscard]] ExplicitReport failure(io::RunStatus status, const std::string& reason) const;
  [[nodiscard]] ExplicitReport failure_in_element() const;

  const ExplicitBody& body_;
  ExplicitOptions options_;
  ExplicitChambers chambers_;
  SelfContact self_contact_;  ///< of chambers' walls alone, without forces, where the options have none
  std::vector<double> areas_;
  NodeUpdate nodes_;
  BlockLoop loop_;
  std::optional<PneumaticIntegrator> air_;  ///< where there are lines
  ExplicitState state_;
  ExplicitState last_good_;
  ExplicitReport report_;
  double rest_stable_step_ = 0.0;
  double stable_step_ = 0.0;   ///< at the start of an interval
  double energy_noise_ = 0.0;  ///< J, of no meaning in the books
  std::optional<double> relaxation_interval_s_;
  Point common_velocity_{};  ///< of the centre of mass at the start of an interval
  std::vector<double> first_volumes_;
  std::vector<double> current_positions_;
  AlignedNumbers element_slots_;
  std::vector<double> chamber_slots_;
  std::vector<ElementsOutcome> outcomes_;
  std::vector<NodesOutcome> moves_;
};

/// Advances to each of the times (increasing) and calls observe there, the start included; ends where a run does not complete.
const ExplicitReport& follow(ExplicitDynamics& dynamics, const std::vector<double>& times_s,
                             const std::function<void(ExplicitDynamics&)>& observe);

}  // namespace menger::fem
