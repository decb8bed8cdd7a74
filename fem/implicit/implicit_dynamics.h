#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/implicit/implicit_contact.h"
#include "fem/implicit/implicit_scheme.h"
#include "fem/implicit/implicit_viscosity.h"
#include "fem/motion/implicit_state.h"
#include "fem/pneumatics/pressure_schedule.h"
#include "fem/space/petsc_handle.h"
#include "fem/statics/chamber_gap.h"
#include "fem/statics/linear_solver.h"
#include "fem/statics/newton_solver.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// Settings of implicit dynamics.
struct ImplicitOptions {
  std::vector<PlenumSchedule> schedules;   ///< one per plenum; empty: no pressure
  std::vector<double> viscosities_Pa_s{};  ///< one per region, see ImplicitViscosity; empty: none
  bool lumped_mass = false;                ///< row sums in place of the consistent mass
  double mass_damping_per_s = 0.0;         ///< alpha >= 0: a force -alpha M v
  std::optional<RigidGround> ground{};
  double stick_stiffness = 1.0;  ///< stiffness of stick springs over that of normal springs, > 0, see ImplicitContact
  double spectral_radius = 0.5;  ///< in [0, 1], see generalised_alpha
  /// > 0: largest local error of a step, root mean square weighted by mass, over the body's diameter.
  double tolerance = 2e-5;
  double newton_tolerance = 0.05;  ///< > 0: of Newton's method, as a part of `tolerance`
  double first_step_s = 1e-5;      ///< > 0
  double smallest_step_s = 1e-8;   ///< > 0; the run ends if a shorter step is needed
  double largest_step_s = 0.1;     ///< > 0
  /// Largest volume of a chamber over its volume at rest; beyond it the run ends as `diverged`.
  double largest_volume_ratio = 20;
  LinearOptions linear{};
  const std::atomic<bool>* stop = nullptr;  ///< ends a run as `stopped` when it becomes true
};

/// How a run ended.
struct ImplicitReport {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};  ///< why the run did not complete
};

/// Moves a hollow body in time by implicit dynamics: M u'' + F(u) + D(u) u' = f(u, t).
///
/// The elements are those of the quasi-static reference (degree 1 or 2, condensed three fields). Loads are its follower pressure
/// and gravity (those of Body), the viscosity of Kelvin and Voigt, and the rigid ground of explicit dynamics. Masses are
/// consistent or lumped. All members are collective.
///
/// The time integrator is the generalised-alpha method. The step size follows an estimate of the local error of the
/// displacements: c h^2 (a1 - a0), filtered by (M + b h^2 K)^-1 M. The filter removes motion that is too fast for the step. The
/// scheme damps such motion, so it must not shorten the step. A step is repeated with a shorter length if its error is above the
/// tolerance, if Newton's method fails, or if walls of a chamber might have crossed undetected. The run ends where an element
/// stays inverted or the step falls below the smallest one.
///
/// Comparison with a general solver of SUNDIALS: at equal error, IDA (BDF of variable order) takes 0.74 of this scheme's time
/// over a period of the driven module of 20 mm without friction, 0.68 with friction regularised at 50 mm/s, and 3.9 times its
/// time at 1 mm/s, where kinks force it to short steps. IDA cannot treat nodes that stick exactly
/// (tests/benchmark/implicit_ida.md).
///
/// Accuracy of walking: the test case is a module of 20 mm under 6 kPa at 3 Hz, with a backward friction of 0.3 of the forward
/// one. The module balances on the few nodes of its bulging base and tips from period to period, so that small differences grow
/// threefold in each period. In explicit dynamics its displacement is 259 um in three periods, at any step. The table is for
/// implicit dynamics with lumped masses. Each entry gives the displacement in um, the mean place in the third period in um, and
/// the seconds of a core. The values are those of bench-implicit, except for stick springs of 100:
///   stick springs        1           3           10          30          100
///   tolerance 2e-5   232 165 11  238 167 16  250 174 27  239 166 67  239 165 188
///   tolerance 5e-6   233 158 13              252 168 33  248 164 66
///   tolerance 1.25e-6                                    256 160 68
/// With consistent masses the displacement is 188 um and the mean place 133 um. From stick springs of 30 on, the displacement no
/// longer changes with the stiffness, as if nodes stuck exactly. There it approaches that of explicit dynamics as steps get
/// shorter: the difference falls from 20 to 11 to 3 um. All of this is less than the uncertainty of the friction model. In
/// explicit dynamics, whose nodes stick exactly, the displacement changes by at most 1 um if friction changes by 0.1 % or the
/// start by 0.1 ms. But it changes to 276 um with friction regularised at 0.1 mm/s, and to 267 and 192 um on a ground of half and
/// double the stiffness. The result depends on how masses and compliances are distributed over the nodes that touch the ground.
/// Hence the defaults, stick springs of 1 and a tolerance of 2e-5: they are within 10 % of explicit dynamics at the least cost.
/// The mean place in the third period is 153 um in explicit dynamics, and that in the second period 53 um; here the latter is 45
/// to 52 um. The place at the end also depends on the phase of a sway of 20 um at 43 Hz. The greatest height agrees to 0.1 %.
///
/// Energy balance: the work of pressure is the mean pressure times the change of volume, and the friction loss is the mean force
/// times the slip. The terms are those of MotionEnergies, where `contact_J` is minus the energy stored in normal and stick
/// springs. The imbalance is the energy that the scheme dissipated (spectral radius < 1) plus the error of the step, of second
/// order. It is negative where energy was lost.
class ImplicitDynamics {
 public:
  /// Starts with the body at rest in its reference configuration. Keeps references. The ground is given in the options, not in
  /// the body.
  /// @throws io::InputError for options outside their ranges, if the number of schedules or viscosities is not that of the body's
  /// plena or regions, for densities that are not positive, for plates, and for a body with a ground of its own
  ImplicitDynamics(const Space& space, const Body& body, ImplicitOptions options);
  ImplicitDynamics(const ImplicitDynamics&) = delete;
  ImplicitDynamics& operator=(const ImplicitDynamics&) = delete;

  /// Sets the state from which the run continues, see ExplicitDynamics::set_state. If displacements or velocities were changed,
  /// `accelerations_m_per_s2` and `at_start_J` must be empty.
  /// @throws io::InputError where an element is inverted
  void set_state(ImplicitState state);
  [[nodiscard]] const ImplicitState& state() const { return state_; }

  /// Advances to exactly this time. If a run does not complete, its state is the last good one, and further calls return the same
  /// report.
  [[nodiscard]] const ImplicitReport& advance_to(double time_s);

  [[nodiscard]] const Space& space() const { return assembly_.space(); }
  [[nodiscard]] const Assembly& assembly() const { return assembly_; }
  [[nodiscard]] std::vector<double> chamber_volumes_m3() const { return forces_.totals.chamber_volumes_m3; }
  [[nodiscard]] double plenum_pressure_Pa(std::size_t plenum) const;
  [[nodiscard]] MotionEnergies energies();
  [[nodiscard]] double ground_force_N() const { return forces_.ground.force_N; }  ///< upwards on the body
  [[nodiscard]] const std::vector<double>& masses_kg() const { return masses_; }  ///< row sums of M, one per owned node
  [[nodiscard]] double mass_kg() const { return mass_kg_; }
  [[nodiscard]] Point centre_of_mass_m() const;
  [[nodiscard]] int factorisations() const { return newton_.tangents(); }

 private:
  /// All forces at a time except inertia, as a residual, with the related totals.
  struct Forces {
    std::vector<double> residual_N;
    std::vector<double> pressures_Pa;
    std::vector<GroundNode> ground_nodes;
    BodyTotals totals;
    GroundTotals ground;
    std::vector<double> viscous_N{};
    std::vector<double> mass_damping_N{};
  };
  /// The end of a step that is being taken.
  struct Trial {
    double time_s = 0.0;
    double step_s = 0.0;
    std::vector<double> accelerations;
    std::vector<double> velocities;
    Forces forces;
    /// The last state that Newton's method has evaluated, and its residual.
    std::vector<double> displacements{};
    std::vector<double> residual{};
  };
  enum class StepOutcome { good, inaccurate, unsolved, inverted, crossing, stopped };

  void check(const Body& body) const;
  void weigh();
  void add_masses(double factor, Mat matrix) const;
  [[nodiscard]] NewtonProblem problem();
  [[nodiscard]] NewtonOptions newton_options();
  bool compute_forces(std::span<const double> u, Forces& forces, bool are_remembered = false);
  void add_mass_damping(Forces& forces);
  void follow_displacements(std::span<const double> u);
  bool compute_residual(Vec x, Vec residual);
  bool prepare_matrix(Vec x);
  void compute_matrix(std::span<const double> u, Mat matrix);
  void add_inertia(std::span<double> residual);
  [[nodiscard]] NewtonVerdict check(const NewtonIterate& iterate) const;
  [[nodiscard]] bool is_balanced(std::span<const double> residual) const;
  [[nodiscard]] double size_of(std::span<const double> field) const;
  void start_from_forces();
  StepOutcome try_step(double step_s, std::vector<double>& u);
  [[nodiscard]] double error_of_step();
  [[nodiscard]] double approach_m(std::span<const double> from, std::span<const double> to) const;
  StepOutcome look_at_walls(std::span<const double> u);
  bool look_from(std::span<const double> u);
  [[nodiscard]] double mean_work(std::span<const double> before, std::span<const double> after, std::span<const double> u) const;
  void accept(std::vector<double>&& u);
  void pass_step(double end_s);
  void fail(io::RunStatus status, const std::string& reason);
  [[nodiscard]] StepMotion motion_to(std::span<const double> u) const;
  [[nodiscard]] double sum_over_ranks(double value) const;
  void copy_owned(std::span<const double> field, Vec vector) const;
  void copy_owned(Vec vector, std::vector<double>& field) const;

  const Body& body_;
  ImplicitOptions options_;
  GeneralisedAlpha scheme_;
  Assembly assembly_;
  ImplicitViscosity viscosity_;
  std::optional<ImplicitContact> contact_;
  ChamberGaps gaps_;
  LinearSolver linear_;
  VectorHandle unknown_;
  NewtonSolver newton_;
  MatrixHandle mass_;
  VectorHandle work_in_;
  VectorHandle work_out_;
  std::vector<double> masses_;
  double mass_kg_ = 0.0;
  double tolerance_m_ = 0.0;
  double factorised_step_s_ = 0.0;
  double error_ = 0.0;  ///< of the last step, over the tolerance
  ImplicitState state_;
  Forces forces_;  ///< at the state
  Trial trial_;
  ImplicitReport report_;
  std::vector<double> first_volumes_;
  std::vector<double> gap_displacements_;  ///< at the last check of the walls
  std::optional<double> gap_m_;
};

}  // namespace menger::fem
