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

/// How a body is moved on in time.
struct ImplicitOptions {
  std::vector<PlenumSchedule> schedules;   ///< one per plenum; empty: no pressure
  std::vector<double> viscosities_Pa_s{};  ///< one per region, see ImplicitViscosity; empty: none
  bool lumped_mass = false;                ///< row sums in place of the consistent mass
  double mass_damping_per_s = 0.0;         ///< alpha >= 0: a force -alpha M v
  std::optional<RigidGround> ground{};
  double stick_stiffness = 1.0;      ///< of stick springs by normal ones, > 0, see ImplicitContact
  double spectral_radius = 0.5;      ///< in [0, 1], see generalised_alpha
  double tolerance = 2e-5;           ///< > 0: local error of a step, root mean square by mass, by the body's diameter
  double newton_tolerance = 0.05;    ///< > 0: what Newton's method may leave, by the tolerance
  double first_step_s = 1e-5;        ///< > 0
  double smallest_step_s = 1e-8;     ///< > 0; below it the run ends
  double largest_step_s = 0.1;       ///< > 0
  double largest_volume_ratio = 20;  ///< of a chamber to its start; beyond it has run away: diverged
  LinearOptions linear{};
  const std::atomic<bool>* stop = nullptr;  ///< ends a run as `stopped` when it becomes true
};

/// How far a run came.
struct ImplicitReport {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};  ///< in words, where it did not complete
};

/// Implicit dynamics of a hollow body: M u'' + F(u) + D(u) u' = f(u, t), with the elements of the quasi-static reference (degree
/// 1 or 2, condensed three fields), its follower pressure and gravity (those of Body), consistent or lumped mass, Kelvin and
/// Voigt's viscosity and the rigid ground of explicit dynamics. All members are collective.
///
/// Time goes on by the generalised-alpha method. The step follows an estimate of the local error of the displacements, from
/// c h^2 (a1 - a0), filtered by (M + b h^2 K)^-1 M so that motion too fast for a step, which the scheme damps, does not hold it
/// up. A step is taken again, shorter, if the error is above the tolerance, if Newton's method fails or if walls of a chamber
/// might have crossed unseen. It ends where an element stays inside out or the step falls below the smallest.
///
/// Why no general solver of SUNDIALS: at equal error IDA (BDF of variable order) takes 0.74 of this scheme's time over a period
/// of the driven module of 20 mm without friction, 0.68 with friction regularised at 50 mm/s, and 3.9 times it at 1 mm/s, where
/// kinks take it back to short steps; nodes that stick exactly it does not know (tests/benchmark/implicit_ida.md).
///
/// How far a body walks: a module of 20 mm under 6 kPa at 3 Hz, backward friction 0.3 of the forward one, balances on the few
/// nodes of its bulging base and tips from period to period, which makes small differences grow threefold in each. By explicit
/// dynamics it walks 259 um in three periods, at any step. Here, with lumped masses (way in um, mean place in the third period in
/// um, seconds of a core; bench-implicit, but for springs of 100):
///   stick springs        1           3           10          30          100
///   tolerance 2e-5   232 165 11  238 167 16  250 174 27  239 166 67  239 165 188
///   tolerance 5e-6   233 158 13              252 168 33  248 164 66
///   tolerance 1.25e-6                                    256 160 68
/// and 188 and 133 um with consistent masses. From springs of 30 on the way does not change any more, as if nodes stuck exactly;
/// from there it goes to that of explicit dynamics with shorter steps: 20, 11 and 3 um are missing. All of this is less than what
/// the model of friction leaves open: explicit dynamics itself, whose nodes do stick exactly, changes by no more than 1 um if
/// friction changes by 0.1 % or the start by 0.1 ms, but to 276 um with friction regularised at 0.1 mm/s, and to 267 and 192 um
/// on a ground of half and double the stiffness. What decides is how masses and compliances are spread over the nodes that touch.
/// Hence the defaults, springs of 1 and a tolerance of 2e-5, 10 % from explicit dynamics at the least cost. The mean place in the
/// third period is 153 um by explicit dynamics, that in the second 53, here 45 to 52; the place at the end holds the phase of a
/// sway of 20 um at 43 Hz, too. The highest place agrees to 0.1 %.
///
/// Pressure does the work of mean pressure times change of volume, friction that of mean force times slip: the books are those of
/// ExplicitEnergies with `contact_J` minus what is stored in normal and stick springs. Their imbalance is what the scheme took
/// out (spectral radius < 1) and the error of the step, of second order; negative where energy was lost.
class ImplicitDynamics {
 public:
  /// The body at rest in its reference configuration. Keeps references. The ground of options takes the place of that of the
  /// body.
  /// @throws io::InputError for options outside their ranges, as many schedules or viscosities as the body has not plena or
  /// regions, densities that are not positive, plates, and a body with a ground of its own
  ImplicitDynamics(const Space& space, const Body& body, ImplicitOptions options);
  ImplicitDynamics(const ImplicitDynamics&) = delete;
  ImplicitDynamics& operator=(const ImplicitDynamics&) = delete;

  /// Another start, see ExplicitDynamics::set_state; after a change of displacements or velocities `accelerations_m_per_s2` and
  /// `at_start_J` must be empty. @throws io::InputError where an element is inside out
  void set_state(ImplicitState state);
  [[nodiscard]] const ImplicitState& state() const { return state_; }

  /// To a time, exactly. Once a run has not completed, the state is the last good one, and further calls return the same report.
  [[nodiscard]] const ImplicitReport& advance_to(double time_s);

  [[nodiscard]] const Space& space() const { return assembly_.space(); }
  [[nodiscard]] const Assembly& assembly() const { return assembly_; }
  [[nodiscard]] std::vector<double> chamber_volumes_m3() const { return forces_.totals.chamber_volumes_m3; }
  [[nodiscard]] double plenum_pressure_Pa(std::size_t plenum) const;
  [[nodiscard]] ExplicitEnergies energies();
  [[nodiscard]] double ground_force_N() const { return forces_.ground.force_N; }  ///< upwards on the body
  [[nodiscard]] const std::vector<double>& masses_kg() const { return masses_; }  ///< row sums of M per owned node
  [[nodiscard]] double mass_kg() const { return mass_kg_; }
  [[nodiscard]] Point centre_of_mass_m() const;
  [[nodiscard]] int factorisations() const { return newton_.tangents(); }

 private:
  /// Forces at a time but for inertia, as a residual, and what comes with them.
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
    std::vector<double> displacements{};  ///< of the state that Newton's method has evaluated last, and its residual
    std::vector<double> residual{};
  };
  enum class Judgement { good, inaccurate, unsolved, inverted, crossing, stopped };

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
  [[nodiscard]] NewtonVerdict judge(const NewtonIterate& iterate) const;
  [[nodiscard]] bool is_balanced(std::span<const double> residual) const;
  [[nodiscard]] double size_of(std::span<const double> field) const;
  void start_from_forces();
  Judgement try_step(double step_s, std::vector<double>& u);
  [[nodiscard]] double error_of_step();
  [[nodiscard]] double approach_m(std::span<const double> from, std::span<const double> to) const;
  Judgement look_at_walls(std::span<const double> u);
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
  double error_ = 0.0;  ///< of the last step, by the tolerance
  ImplicitState state_;
  Forces forces_;  ///< at the state
  Trial trial_;
  ImplicitReport report_;
  std::vector<double> first_volumes_;
  std::vector<double> gap_displacements_;  ///< where the walls were looked at last
  std::optional<double> gap_m_;
};

}  // namespace menger::fem
