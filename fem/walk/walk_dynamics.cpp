#include "fem/walk/walk_dynamics.h"

#include <memory>
#include <utility>

#include "fem/device/cuda_step_taker.h"

namespace menger::fem {
namespace {

class ExplicitWalk final : public WalkDynamics {
 public:
  ExplicitWalk(const PreparedWalk& walk, ExplicitOptions options)
      : body_(walk.mesh, body_options(walk)),
        dynamics_(walk.mesh, body_, with_device(walk, std::move(options))),
        plenum_count_(walk.mesh.plenum_names.size()) {}

  WalkOutcome advance_to(double time_s) override {
    const ExplicitReport& report = dynamics_.advance_to(time_s);
    return {report.status, report.reason};
  }
  void set_state(WalkState state) override { dynamics_.set_state(std::get<ExplicitState>(std::move(state))); }
  [[nodiscard]] std::string misfit(const WalkState& state) const override {
    const auto* of_this_method = std::get_if<ExplicitState>(&state);
    return of_this_method != nullptr ? dynamics_.misfit(*of_this_method) : "it is a state of implicit dynamics";
  }
  [[nodiscard]] WalkState state() const override { return dynamics_.state(); }
  [[nodiscard]] double time_s() const override { return dynamics_.state().time_s; }
  [[nodiscard]] std::size_t steps() const override { return dynamics_.state().steps; }
  [[nodiscard]] bool goes_on_from_any_state() const override { return true; }
  [[nodiscard]] std::string machine_text() const override {
    return body_.elements().text() + (step_taker_ ? ", steps by " + step_taker_->text() : "");
  }

  [[nodiscard]] WalkRecord record() override {
    WalkRecord record;
    record.time_s = dynamics_.state().time_s;
    record.centre_of_mass_m = dynamics_.centre_of_mass_m();
    for (std::size_t p = 0; p < plenum_count_; ++p) record.plenum_pressures_Pa.push_back(dynamics_.plenum_pressure_Pa(p));
    record.chamber_volumes_m3 = dynamics_.chamber_volumes_m3();
    record.energies = dynamics_.energies();
    record.ground_force_N = dynamics_.ground_force_N();
    return record;
  }
  [[nodiscard]] std::vector<double> displacements_m() const override { return dynamics_.state().displacements_m; }
  [[nodiscard]] std::vector<double> velocities_m_per_s() override { return dynamics_.velocities_m_per_s(); }

 private:
  ExplicitOptions with_device(const PreparedWalk& walk, ExplicitOptions options) {
    if (walk.device == io::Device::cuda) step_taker_ = cuda_step_taker(walk.mesh, body_, body_options(walk), options.loads);
    options.step_taker = step_taker_;
    return options;
  }

  ExplicitBody body_;
  std::shared_ptr<StepTaker> step_taker_;  ///< empty where this processor takes the steps
  ExplicitDynamics dynamics_;
  std::size_t plenum_count_;
};

}  // namespace

std::unique_ptr<WalkDynamics> explicit_walk_dynamics(const PreparedWalk& walk, const std::atomic<bool>* stop) {
  ExplicitOptions options = dynamics_options(walk);
  options.stop = stop;
  return std::make_unique<ExplicitWalk>(walk, std::move(options));
}

}  // namespace menger::fem
