#pragma once

#include <xsimd/xsimd.hpp>

#include "voxel/laws/number.h"

namespace menger::voxel {

/// A SIMD pack as a number of the laws. It stands apart from number.h because graphics processors have no packs.
template <class R, class Arch>
struct NumberTraits<xsimd::batch<R, Arch>> {
  using Real = R;
  using Mask = xsimd::batch_bool<R, Arch>;
  static constexpr int width = static_cast<int>(xsimd::batch<R, Arch>::size);
};

}  // namespace menger::voxel
