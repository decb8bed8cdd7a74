#pragma once

#include <vector>
#include <xsimd/xsimd.hpp>

namespace menger::fem {

/// Numbers aligned for SIMD packs.
template <class Number>
using AlignedVector = std::vector<Number, xsimd::aligned_allocator<Number, 64>>;
using AlignedNumbers = AlignedVector<double>;

}  // namespace menger::fem
