#include "voxel/device/device_group.h"

#include <algorithm>
#include <array>

namespace menger::voxel {

namespace {

/// Steps between two looks at the clock and at origins: about a tenth of a second on a full device.
constexpr std::uint64_t steps_of_piece = 4096;

}  // namespace

template <class Real>
DeviceGroup<Real>::DeviceGroup(const std::vector<MovingBody<Real>*>& robots, const std::vector<FootContact<Real>*>& feet,
                               Stepper stepper)
    : batch_(robots, feet), runner_(robot_runner(batch_, stepper)) {}

template <class Real>
std::vector<std::uint32_t> DeviceGroup<Real>::next_piece(const std::vector<std::uint64_t>& left) const {
  std::vector<std::uint32_t> piece;
  for (std::size_t i = 0; i < left.size(); ++i)
    piece.push_back(batch_.goes_on(i) ? static_cast<std::uint32_t>(std::min(left[i], steps_of_piece)) : 0);
  return piece;
}

/// Moves the origins of robots that are far from theirs, as MovingBody does after steps of its own.
template <class Real>
void DeviceGroup<Real>::take_origins_along() {
  std::vector<std::size_t> far;
  for (std::size_t i = 0; i < batch_.robots().size(); ++i) {
    const auto& middle = batch_.outcomes[i].middle_m;
    if (batch_.steps[i] > 0 && batch_.goes_on(i) && batch_.robots()[i]->is_far({middle[0], middle[1], middle[2]}))
      far.push_back(i);
  }
  if (far.empty()) return;
  runner_->fetch_state();
  for (const std::size_t i : far) {
    batch_.take(i);
    batch_.put(i);
  }
  runner_->send_state();
}

template <class Real>
void DeviceGroup<Real>::advance(std::vector<std::uint64_t> counts, const std::atomic<bool>* stop) {
  while (stop == nullptr || !stop->load(std::memory_order_relaxed)) {
    const std::vector<std::uint32_t> piece = next_piece(counts);
    if (std::ranges::all_of(piece, [](std::uint32_t steps) { return steps == 0; })) break;
    batch_.plan(piece);
    runner_->run();
    batch_.note_outcomes();
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] -= piece[i];
    take_origins_along();
  }
  runner_->fetch_state();
  for (std::size_t i = 0; i < batch_.robots().size(); ++i) batch_.take(i);
}

template class DeviceGroup<double>;
template class DeviceGroup<float>;

}  // namespace menger::voxel
