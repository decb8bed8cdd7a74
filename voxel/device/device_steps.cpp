#include "voxel/device/device_steps.h"

#include <algorithm>
#include <type_traits>

#include "voxel/device/device_group.h"
#include "voxel/engine/engine.h"
#include "voxel/lanes/lanes.h"

namespace menger::voxel {

namespace {

template <class Real>
bool runs_on_device(const EngineOf<Real>& engine) {
  return !engine.energy() && engine.options().kept_terms() == KeptTerms{} && !engine.record().divergence;
}

/// Advances all robots of one number type that run on the device. The others stay as they are.
template <class Real>
void advance_kind_on_device(std::span<Engine* const> engines, double time_s, const std::atomic<bool>* stop, Stepper stepper) {
  constexpr NumberType number = std::is_same_v<Real, double> ? NumberType::float64 : NumberType::float32;
  std::vector<MovingBody<Real>*> robots;
  std::vector<FootContact<Real>*> feet;
  std::vector<std::uint64_t> steps;
  for (Engine* engine : engines) {
    if (engine->body().physics.integration.number != number) continue;
    auto* robot = static_cast<EngineOf<Real>*>(engine);
    const std::uint64_t end = steps_until(time_s, robot->body().time_step_s);
    if (!runs_on_device(*robot) || robot->record().steps >= end) continue;
    robots.push_back(&robot->moving_body());
    feet.push_back(robot->feet());
    steps.push_back(end - robot->record().steps);
  }
  if (!robots.empty()) DeviceGroup<Real>(robots, feet, stepper).advance(std::move(steps), stop);
}

}  // namespace

DeviceAdvance advance_on_device_to(std::span<Simulation> simulations, double time_s, const std::atomic<bool>* stop,
                                   Stepper stepper) {
  std::vector<Engine*> engines;
  for (Simulation& simulation : simulations) engines.push_back(simulation.engine_.get());
  advance_kind_on_device<double>(engines, time_s, stop, stepper);
  advance_kind_on_device<float>(engines, time_s, stop, stepper);
  DeviceAdvance advance;
  const bool stopped = stop != nullptr && stop->load(std::memory_order_relaxed);
  for (const Engine* engine : engines) {
    const RunRecord& record = engine->record();
    const bool is_left = !record.divergence && record.steps < steps_until(time_s, engine->body().time_step_s);
    advance.on_processor.push_back(is_left && !stopped);
  }
  // For the others this only returns the status: at the end, diverged or stopped.
  advance.statuses = advance_together_to(simulations, time_s, stop);
  return advance;
}

}  // namespace menger::voxel
