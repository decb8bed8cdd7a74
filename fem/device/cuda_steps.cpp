#include "fem/device/cuda_steps.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <variant>

#include "fem/device/cuda_workers.h"
#include "io/text/input_error.h"

namespace menger::fem {
namespace {

constexpr std::size_t alignment = 64;

/// Bytes that arrays take one after the other.
class Room {
 public:
  template <class Entry>
  std::size_t add(std::size_t count) {
    const std::size_t begin = (size_ + alignment - 1) / alignment * alignment;
    size_ = begin + count * sizeof(Entry);
    return begin;
  }
  [[nodiscard]] std::size_t size() const { return (size_ + alignment - 1) / alignment * alignment; }

 private:
  std::size_t size_ = 0;
};

constexpr std::size_t words_of(std::size_t bytes) { return (bytes + sizeof(uint4) - 1) / sizeof(uint4); }

}  // namespace

template <class Number>
CudaSteps<Number>::CudaSteps(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, const ExplicitBodyOptions& options,
                             const NodalLoads& loads)
    : arrays_(mesh, body, options, loads, 32) {
  CudaArenas& arenas = CudaArenas::of_process();
  BodyView<Number>& view = task_.body;
  view = arrays_.place(nullptr);  // for its numbers
  task_.kept = BlockMemory::motion;
  while (task_.kept != BlockMemory::displacements && CudaWorkers<Number>::block_bytes(view, task_.kept) > arenas.block_bytes())
    task_.kept = static_cast<BlockMemory>(static_cast<int>(task_.kept) - 1);

  Room state;
  static_cast<void>(state.add<detail::BlockOutcome>(1));
  volumes_at_ = state.add<double>(2 * view.plenum_count);
  displacements_at_ = state.add<double>(3 * view.node_count);
  velocities_at_ = state.add<double>(3 * view.node_count);
  branches_at_ = state.add<Number>(arrays_.given_branch_count());
  pressures_at_ = state.add<double>((most_steps + 2) * view.plenum_count);
  const std::size_t lanes = view.width * view.batch_count;
  Room scratch;
  const std::size_t rates = scratch.add<Number>(view.is_viscous ? 3 * view.node_count + 1 : 0);
  const std::size_t forces = scratch.add<Number>(task_.kept == BlockMemory::displacements ? view.force_number_count : 0);
  const std::size_t branches = scratch.add<Number>(view.branch_number_count);
  const std::size_t walls = scratch.add<Number>(lanes);
  const std::size_t sides = scratch.add<Number>(2 * lanes);
  const std::size_t faces = scratch.add<Number>(view.width * view.face_batch_count);
  Room arrays;
  static_cast<void>(arrays.add<std::byte>(arrays_.bytes().size()));
  Room done;
  static_cast<void>(done.add<std::uint32_t>(1));

  host_size_ = state.size() + arrays.size() + done.size();
  device_size_ = state.size() + arrays.size() + scratch.size();
  const auto too_large = [](const char* where, std::size_t bytes) {
    return io::InputError("this body is too large for a graphics processor: it takes " + std::to_string(bytes) + " bytes " +
                          where);
  };
  if (CudaWorkers<Number>::block_bytes(view, task_.kept) > arenas.block_bytes())
    throw too_large("of the memory of a block of threads", CudaWorkers<Number>::block_bytes(view, task_.kept));
  const auto host_begin = arenas.host.take(host_size_);
  if (!host_begin) throw too_large("of the memory for copies", host_size_);
  host_begin_ = *host_begin;
  const auto device_begin = arenas.device.take(device_size_);
  if (!device_begin) {
    arenas.host.give_back(host_begin_, host_size_);
    throw too_large("of its memory", device_size_);
  }
  device_begin_ = *device_begin;

  host_ = arenas.host_memory() + host_begin_;
  std::byte* const host_arrays = host_ + state.size();
  std::byte* const device = arenas.device_memory() + device_begin_;
  std::byte* const device_arrays = device + state.size();
  std::byte* const device_scratch = device_arrays + arrays.size();
  view = arrays_.place(device_arrays);
  std::memcpy(host_arrays, arrays_.bytes().data(), arrays_.bytes().size());
  task_.host_arrays = reinterpret_cast<const uint4*>(host_arrays);
  task_.arrays = reinterpret_cast<uint4*>(device_arrays);
  task_.array_words = words_of(arrays_.bytes().size());
  task_.done = reinterpret_cast<std::uint32_t*>(host_arrays + arrays.size());
  task_.host_state = reinterpret_cast<uint4*>(host_);
  task_.state = reinterpret_cast<uint4*>(device);
  task_.given_words = words_of(pressures_at_);
  task_.outcome = reinterpret_cast<detail::BlockOutcome*>(device);
  task_.volumes_m3 = reinterpret_cast<double*>(device + volumes_at_);
  const auto scratch_at = [&](std::size_t offset) { return reinterpret_cast<Number*>(device_scratch + offset); };
  task_.memory = {.displacements_m = reinterpret_cast<double*>(device + displacements_at_),
                  .velocities_m_per_s = reinterpret_cast<double*>(device + velocities_at_),
                  .rates_m_per_s = scratch_at(rates),
                  .forces_N = scratch_at(forces),
                  .branches = scratch_at(branches),
                  .given_branches = reinterpret_cast<Number*>(device + branches_at_),
                  .wall_volumes_m3 = scratch_at(walls),
                  .side_volumes_m3 = scratch_at(sides),
                  .face_volumes_m3 = scratch_at(faces),
                  .pressures_Pa = reinterpret_cast<double*>(device + pressures_at_)};
}

template <class Number>
CudaSteps<Number>::~CudaSteps() {
  CudaArenas::of_process().host.give_back(host_begin_, host_size_);
  CudaArenas::of_process().device.give_back(device_begin_, device_size_);
}

template <class Number>
std::string CudaSteps<Number>::text() const {
  return std::string("CUDA, ") + (sizeof(Number) == 4 ? "single" : "double") + " precision";
}

template <class Number>
StepsOutcome CudaSteps<Number>::take(const StepsOrder& order, const SteppedBody& body) {
  auto& branches = std::get<AlignedVector<Number>>(body.branches);
  assert(branches.size() == arrays_.given_branch_count());
  const std::size_t motion_bytes = body.displacements_m.size() * sizeof(double);
  const std::size_t branch_bytes = branches.size() * sizeof(Number);
  task_.order = detail::block_order(order);
  task_.order.count = std::min(order.count, most_steps);
  const std::size_t pressure_bytes = (task_.order.count + 2) * task_.body.plenum_count * sizeof(double);
  std::memcpy(host_ + displacements_at_, body.displacements_m.data(), motion_bytes);
  std::memcpy(host_ + velocities_at_, body.velocities_m_per_s.data(), motion_bytes);
  if (branch_bytes > 0) std::memcpy(host_ + branches_at_, branches.data(), branch_bytes);
  if (pressure_bytes > 0) std::memcpy(host_ + pressures_at_, order.pressures_Pa.data(), pressure_bytes);
  task_.words = words_of(pressures_at_ + pressure_bytes);

  CudaWorkers<Number>::of_law(arrays_.law()).run(task_);
  task_.array_words = 0;

  detail::BlockOutcome outcome;
  std::memcpy(&outcome, host_, sizeof(outcome));
  std::memcpy(body.displacements_m.data(), host_ + displacements_at_, motion_bytes);
  std::memcpy(body.velocities_m_per_s.data(), host_ + velocities_at_, motion_bytes);
  if (branch_bytes > 0) std::memcpy(branches.data(), host_ + branches_at_, branch_bytes);
  std::vector<double> volumes(2 * task_.body.plenum_count);
  if (!volumes.empty()) std::memcpy(volumes.data(), host_ + volumes_at_, volumes.size() * sizeof(double));
  return detail::outcome_of(outcome, volumes);
}

template class CudaSteps<float>;
template class CudaSteps<double>;

}  // namespace menger::fem
