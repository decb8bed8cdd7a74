#include "voxel/kernels/instruction_sets.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace menger::voxel {

namespace {

bool machine_has(InstructionSet set) {
#ifdef MENGER_X86_KERNELS
  // The compiler's test is used, not that of xsimd, which does not check whether the operating system saves the wide registers.
  switch (set) {
    case InstructionSet::scalar:
      return true;
    case InstructionSet::sse2:
      return __builtin_cpu_supports("sse2") != 0;
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case InstructionSet::avx512:
#ifdef MENGER_AVX512_KERNELS
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
#else
      return false;
#endif
    case InstructionSet::best:
      break;
  }
  return false;
#else
  return set == InstructionSet::scalar;
#endif
}

}  // namespace

InstructionSet resolve(InstructionSet requested) {
  if (requested == InstructionSet::best) {
    for (const InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::sse2}) {
      if (machine_has(set)) return set;
    }
    return InstructionSet::scalar;
  }
  if (!machine_has(requested))
    throw std::invalid_argument("this machine has no " + std::string(to_string(requested)) + " kernels");
  return requested;
}

template <>
const StepKernels<double>& kernels_for<double>(InstructionSet set) {
#ifdef MENGER_AVX512_KERNELS
  if (set == InstructionSet::avx512) return avx512_kernels_double();
#endif
#ifdef MENGER_X86_KERNELS
  if (set == InstructionSet::avx2) return avx2_kernels_double();
  if (set == InstructionSet::sse2) return sse2_kernels_double();
#endif
  (void)set;
  return scalar_kernels_double();
}

template <>
const StepKernels<float>& kernels_for<float>(InstructionSet set) {
#ifdef MENGER_AVX512_KERNELS
  if (set == InstructionSet::avx512) return avx512_kernels_float();
#endif
#ifdef MENGER_X86_KERNELS
  if (set == InstructionSet::avx2) return avx2_kernels_float();
  if (set == InstructionSet::sse2) return sse2_kernels_float();
#endif
  (void)set;
  return scalar_kernels_float();
}

namespace {

/// Returns the lane kernels of the instruction sets up to a resolved one, from few lanes to many. The scalar kernels are returned
/// only where there are no others.
template <class Real>
std::vector<const LaneKernels<Real>*> lane_kernels_up_to(InstructionSet set) {
  constexpr bool is_double = std::is_same_v<Real, double>;
  std::vector<const LaneKernels<Real>*> all;
  const auto add = [&](const LaneKernels<double>& (*doubles)(), const LaneKernels<float>& (*floats)()) {
    if constexpr (is_double) {
      all.push_back(&doubles());
    } else {
      all.push_back(&floats());
    }
  };
#ifdef MENGER_X86_KERNELS
  if (set >= InstructionSet::sse2) add(sse2_lane_kernels_double, sse2_lane_kernels_float);
  if (set >= InstructionSet::avx2) add(avx2_lane_kernels_double, avx2_lane_kernels_float);
#endif
#ifdef MENGER_AVX512_KERNELS
  if (set >= InstructionSet::avx512) add(avx512_lane_kernels_double, avx512_lane_kernels_float);
#endif
  if (all.empty()) add(scalar_lane_kernels_double, scalar_lane_kernels_float);
  return all;
}

}  // namespace

template <class Real>
const LaneKernels<Real>& lane_kernels_for(InstructionSet set, std::size_t robots) {
  const std::vector<const LaneKernels<Real>*> all = lane_kernels_up_to<Real>(set);
  const auto holds = [&](const LaneKernels<Real>* kernels) { return static_cast<std::size_t>(kernels->lanes) >= robots; };
  const auto found = std::find_if(all.begin(), all.end(), holds);
  return found == all.end() ? *all.back() : **found;
}

std::size_t most_lanes_of(NumberType number, InstructionSet requested) {
  const InstructionSet set = resolve(requested);
  const bool is_double = number == NumberType::float64;
  return static_cast<std::size_t>(is_double ? lane_kernels_up_to<double>(set).back()->lanes
                                            : lane_kernels_up_to<float>(set).back()->lanes);
}

template <class Real>
const LaneKernels<Real>* kernels_for_blocks(InstructionSet set, std::size_t blocks) {
  constexpr double least_filled = 0.6;  // below it, empty lanes cost as much as sorting voxels into registers
  const LaneKernels<Real>* widest = lane_kernels_up_to<Real>(set).back();
  const auto lanes = static_cast<std::size_t>(widest->lanes);
  const std::size_t slots = (blocks + lanes - 1) / lanes * lanes;
  const bool fills = static_cast<double>(blocks) >= least_filled * static_cast<double>(slots);
  return lanes > 1 && fills ? widest : nullptr;
}

std::string_view to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::best:
      return "best";
    case InstructionSet::scalar:
      return "scalar";
    case InstructionSet::sse2:
      return "sse2";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "best";
}

template const LaneKernels<double>& lane_kernels_for<double>(InstructionSet, std::size_t);
template const LaneKernels<float>& lane_kernels_for<float>(InstructionSet, std::size_t);
template const LaneKernels<double>* kernels_for_blocks<double>(InstructionSet, std::size_t);
template const LaneKernels<float>* kernels_for_blocks<float>(InstructionSet, std::size_t);

}  // namespace menger::voxel
