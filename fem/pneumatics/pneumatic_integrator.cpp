#include "fem/pneumatics/pneumatic_integrator.h"

#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "fem/pneumatics/pneumatic_flow.h"
#include "io/sundials/handle.h"
#include "io/text/number_text.h"

namespace menger::fem {
namespace {

constexpr int recoverable = 1;           // return value that makes ARKODE try a shorter step
constexpr long most_steps = 1000000;     // largest number of steps without an event
constexpr int most_restarts = 100000;    // largest number of restarts after events, in one smooth part
constexpr double newton_share = 0.1;     // share of the tolerance for Newton's method
constexpr int predict_by_last_step = 1;  // a stage starts from the polynomial of the last step, if there is one

/// The shortest period of pistons and sources, s; infinite without one.
double shortest_period_s(const PneumaticSupply& supply) {
  double highest_Hz = 0.0;
  for (const PneumaticSupply::Group& group : supply.groups()) {
    if (group.piston) {
      highest_Hz = std::max(highest_Hz, supply.pistons()[*group.piston].frequency_Hz);
      continue;
    }
    const PressureSchedule& schedule = supply.source(group).schedule;
    if (const auto* sine = std::get_if<SinePressure>(&schedule)) highest_Hz = std::max(highest_Hz, sine->frequency_Hz);
    if (const auto* square = std::get_if<SquarePressure>(&schedule)) highest_Hz = std::max(highest_Hz, square->frequency_Hz);
  }
  return 1.0 / highest_Hz;
}

}  // namespace

/// Owns ARKODE and its vectors. Times are counted from the start of an advance.
class PneumaticIntegrator::Solver {
 public:
  Solver(const PneumaticSupply& supply, const PneumaticAccuracy& accuracy)
      : supply_(supply),
        flow_(supply_, accuracy.with_works),
        tolerance_(accuracy.tolerance),
        largest_step_s_(accuracy.largest_step_s.value_or(0.1 * shortest_period_s(supply))),
        context_(io::make_sundials_context()),
        unknowns_(io::sundials_made<io::SundialsVector>(
            N_VNew_Serial(static_cast<sunindextype>(flow_.unknown_count()), context_.get()))),
        matrix_(io::sundials_made<io::SundialsMatrix>(SUNDenseMatrix(
            static_cast<sunindextype>(flow_.unknown_count()), static_cast<sunindextype>(flow_.unknown_count()), context_.get()))),
        linear_solver_(
            io::sundials_made<io::SundialsLinearSolver>(SUNLinSol_Dense(unknowns_.get(), matrix_.get(), context_.get()))) {
    N_VConst(0.0, unknowns_.get());
    memory_ = io::sundials_made<Memory>(ARKStepCreate(nullptr, rates, 0.0, unknowns_.get(), context_.get()));
    void* memory = memory_.get();
    demand(ARKStepSetErrHandlerFn(memory, io::print_no_sundials_error, nullptr));
    demand(ARKStepSetUserData(memory, this));
    demand(ARKStepWFtolerances(memory, weights));
    demand(ARKStepSetLinearSolver(memory, linear_solver_.get(), matrix_.get()));
    demand(ARKStepSetJacFn(memory, jacobian));
    demand(ARKStepSetTableNum(memory, ARKODE_ESDIRK324L2SA_4_2_3, ARKODE_ERK_NONE));
    // In lines of hardly any resistance, computed rates are rounding errors times 1 / R; differences of stages are not.
    demand(ARKStepSetDeduceImplicitRhs(memory, SUNTRUE));
    // Few unknowns: a new Jacobian for each stage costs less than iterations with an old one.
    demand(ARKStepSetLSetupFrequency(memory, -1));
    demand(ARKStepSetMaxNonlinIters(memory, 5));
    demand(ARKStepSetPredictorMethod(memory, predict_by_last_step));
    demand(ARKStepSetNonlinConvCoef(memory, newton_share));
    demand(ARKStepSetMaxNumSteps(memory, most_steps));
    demand(ARKStepSetMaxStep(memory, std::isfinite(largest_step_s_) ? largest_step_s_ : 0.0));
  }

  PneumaticReport advance(PneumaticState& state, double time_s, const PlenumWalls& walls, const Observer& observe) {
    assert(time_s > state.time_s);
    start_s_ = state.time_s;
    const double duration = time_s - state.time_s;
    flow_.begin(state, duration, walls);
    std::span<double> unknowns = values(unknowns_.get());
    flow_.start_unknowns(unknowns);
    find_events(observe != nullptr);
    observe_ = observe ? &observe : nullptr;
    for (double begin = 0.0; begin < duration;) {
      const double end = flow_.smooth_part_end_s(begin);
      flow_.set_smooth_part(begin, end);
      PneumaticReport report = pass_smooth_part(begin, end);
      if (report.status == io::RunStatus::stopped) state = std::move(seen_);
      if (report.status != io::RunStatus::completed) return report;
      begin = end;
    }
    if (!flow_.settle(duration, unknowns, seen_)) return empty(duration);
    seen_.time_s = time_s;
    for (const double air : seen_.piston_air_m3)
      if (!(air > 0.0)) return empty(duration);
    std::swap(state, seen_);
    return {.time_s = time_s};
  }

 private:
  using Memory = io::SundialsHandle<void*, ARKStepFree>;

  static std::span<double> values(N_Vector vector) {
    return {N_VGetArrayPointer_Serial(vector), static_cast<std::size_t>(N_VGetLength_Serial(vector))};
  }

  /// A call with correct arguments fails only for lack of memory.
  static void demand(int flag) {
    assert(flag == ARK_SUCCESS || flag == ARK_MEM_FAIL);
    if (flag != ARK_SUCCESS) throw std::bad_alloc();
  }

  static int rates(double since_s, N_Vector unknowns, N_Vector result, void* solver) {
    return static_cast<Solver*>(solver)->flow_.rates(since_s, values(unknowns), values(result)) ? 0 : recoverable;
  }

  static int jacobian(double since_s, N_Vector unknowns, N_Vector /*rates*/, SUNMatrix result, void* solver, N_Vector /*work*/,
                      N_Vector /*work*/, N_Vector /*work*/) {
    const auto columns = static_cast<std::size_t>(SUNDenseMatrix_Columns(result));
    return static_cast<Solver*>(solver)->flow_.jacobian(since_s, values(unknowns), {SUNDenseMatrix_Cols(result), columns})
               ? 0
               : recoverable;
  }

  static int weights(N_Vector unknowns, N_Vector result, void* solver) {
    return static_cast<Solver*>(solver)->set_weights(values(unknowns), values(result));
  }

  static int events(double since_s, N_Vector unknowns, double* result, void* solver) {
    return static_cast<Solver*>(solver)->find(since_s, values(unknowns), result);
  }

  int set_weights(std::span<const double> unknowns, std::span<double> result) const {
    std::ranges::fill(result, 1.0 / (tolerance_ * flow_.energy_scale_J()));
    for (std::size_t l = 0; l < flow_.line_count(); ++l) {
      if (!(unknowns[l] > 0.0)) return -1;
      result[l] = 1.0 / (tolerance_ * unknowns[l]);
    }
    return 0;
  }

  int find(double since_s, std::span<const double> unknowns, double* result) {
    const std::span<double> modes(result, flow_.mode_event_count());
    return flow_.events(since_s, unknowns, modes, {result + modes.size(), found_.size() - modes.size()}) ? 0 : -1;
  }

  /// Sets up root finding for the modes of this step, and for turning points if there is an observer.
  void find_events(bool with_turning_points) {
    const std::size_t modes = flow_.mode_event_count();
    const std::size_t count = modes + (with_turning_points ? flow_.turning_point_count() : 0);
    if (count == found_.size() && modes == modes_) return;
    found_.assign(count, 0);
    modes_ = modes;
    demand(ARKStepRootInit(memory_.get(), static_cast<int>(count), events));
    if (count == 0) return;
    demand(ARKStepSetNoInactiveRootWarn(memory_.get()));
    std::vector<int> directions(count, 0);
    std::fill_n(directions.begin(), modes, -1);
    demand(ARKStepSetRootDirection(memory_.get(), directions.data()));
  }

  void begin_at(double since_s, double step_s) {
    demand(ARKStepReInit(memory_.get(), nullptr, rates, since_s, unknowns_.get()));
    demand(ARKStepSetInitStep(memory_.get(), step_s));
  }

  PneumaticReport pass_smooth_part(double begin_s, double end_s) {
    begin_at(begin_s, end_s - begin_s);
    double since = begin_s;
    for (int restarts = 0; restarts < most_restarts;) {
      demand(ARKStepSetStopTime(memory_.get(), end_s));
      const int flag = ARKStepEvolve(memory_.get(), end_s, unknowns_.get(), &since, ARK_ONE_STEP);
      // ARKODE returns this flag if an event function stays zero for a while after its root. It then stays at the root.
      const bool lingers = flag == ARK_ILL_INPUT && since > begin_s;
      if (flag < 0 && !lingers) return failure(flag, since);
      if (observe_ != nullptr && !lingers) {
        if (!flow_.settle(since, values(unknowns_.get()), seen_)) return empty(since);
        if (!(*observe_)(seen_))
          return {.status = io::RunStatus::stopped, .time_s = start_s_ + since, .reason = "stopped by the observer"};
      }
      if (flag == ARK_TSTOP_RETURN) return {};
      if (!lingers && (flag != ARK_ROOT_RETURN || !change_modes())) continue;
      if (end_s - since <= 1e-12 * end_s) return {};
      ++restarts;
      double step = 0.0;
      demand(ARKStepGetLastStep(memory_.get(), &step));
      begin_at(since, step);
    }
    return failure(ARK_TOO_MUCH_WORK, since);
  }

  /// Changes the modes of the lines at the present event. @return whether any mode changed
  bool change_modes() {
    demand(ARKStepGetRootInfo(memory_.get(), found_.data()));
    bool has_changed = false;
    for (std::size_t n = 0; n < modes_; ++n) {
      if (found_[n] == 0) continue;
      flow_.pass(n);
      has_changed = true;
    }
    return has_changed;
  }

  [[nodiscard]] PneumaticReport empty(double since_s) const {
    return {.status = io::RunStatus::diverged, .time_s = start_s_ + since_s, .reason = "a plenum has no volume or no air left"};
  }

  [[nodiscard]] PneumaticReport failure(int flag, double since_s) const {
    if (flag == ARK_RHSFUNC_FAIL || flag == ARK_FIRST_RHSFUNC_ERR || flag == ARK_REPTD_RHSFUNC_ERR ||
        flag == ARK_UNREC_RHSFUNC_ERR || flag == ARK_RTFUNC_FAIL)
      return empty(since_s);
    const double time = start_s_ + since_s;
    return {.status = io::RunStatus::not_converged,
            .time_s = time,
            .reason = "the flow of air cannot be integrated beyond " + io::number_text(time) + " s"};
  }

  PneumaticSupply supply_;
  PneumaticFlow flow_;
  double tolerance_;
  double largest_step_s_;
  io::SundialsContext context_;
  io::SundialsVector unknowns_;
  io::SundialsMatrix matrix_;
  io::SundialsLinearSolver linear_solver_;
  Memory memory_;
  std::vector<int> found_;  ///< per event: events of modes first, then turning points
  std::size_t modes_ = 0;
  double start_s_ = 0.0;
  const Observer* observe_ = nullptr;
  PneumaticState seen_;
};

PneumaticIntegrator::PneumaticIntegrator(const PneumaticSupply& supply, const PneumaticAccuracy& accuracy)
    : solver_(std::make_unique<Solver>(supply, accuracy)) {}

PneumaticIntegrator::~PneumaticIntegrator() = default;
PneumaticIntegrator::PneumaticIntegrator(PneumaticIntegrator&&) noexcept = default;
PneumaticIntegrator& PneumaticIntegrator::operator=(PneumaticIntegrator&&) noexcept = default;

PneumaticReport PneumaticIntegrator::advance(PneumaticState& state, double time_s, std::span<const double> volumes_m3) {
  for (const double volume : volumes_m3)
    if (!(volume > 0.0) || !std::isfinite(volume))
      return {.status = io::RunStatus::diverged, .time_s = state.time_s, .reason = "a plenum has no volume left"};
  return solver_->advance(state, time_s, {.volumes_m3 = volumes_m3}, {});
}

PneumaticReport PneumaticIntegrator::advance(PneumaticState& state, double time_s, std::span<const PlenumCompliance> plena,
                                             const Observer& observe) {
  return solver_->advance(state, time_s, {.compliances = plena}, observe);
}

}  // namespace menger::fem
