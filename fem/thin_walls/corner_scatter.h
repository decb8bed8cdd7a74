#pragma once

// Lanes into memory: three packs become what each corner has side by side, x y z and a zero. Included only by the kernels of an
// instruction set.

#include <array>
#include <cstddef>

#include "fem/thin_walls/lane_pack.h"

namespace menger::fem::detail {

/// Writes one corner of each lane. A node can then add up its slots four numbers at a time. The first lane's slot is at `slots`;
/// those of the next lanes follow `stride` further each.
template <class T, std::size_t stride>
struct CornerScatter {
  static void scatter(const Vector3<T>& value, NumberOf<T>* slots) {
    constexpr std::size_t width = Lanes<T>::count;
    alignas(64) std::array<NumberOf<T>, 3 * width> buffer;
    for (std::size_t i = 0; i < 3; ++i) Lanes<T>::store(value[i], buffer.data() + i * width);
    for (std::size_t lane = 0; lane < width; ++lane) {
      NumberOf<T>* slot = slots + stride * lane;
      for (std::size_t i = 0; i < 3; ++i) slot[i] = buffer[i * width + lane];
      slot[3] = NumberOf<T>(0);
    }
  }
};

#if XSIMD_WITH_SSE2 && !defined(__AVX__)
template <std::size_t stride>
struct CornerScatter<LanePack<xsimd::batch<float>>, stride> {
  static void scatter(const Vector3<LanePack<xsimd::batch<float>>>& value, float* slots) {
    const __m128 x = value[0].lanes();
    const __m128 y = value[1].lanes();
    const __m128 z = value[2].lanes();
    const __m128 none = _mm_setzero_ps();
    const __m128 xy = _mm_unpacklo_ps(x, y);  // x0 y0 x1 y1
    const __m128 xy_last = _mm_unpackhi_ps(x, y);
    const __m128 z0 = _mm_unpacklo_ps(z, none);
    const __m128 z0_last = _mm_unpackhi_ps(z, none);
    _mm_store_ps(slots, _mm_movelh_ps(xy, z0));
    _mm_store_ps(slots + stride, _mm_movehl_ps(z0, xy));
    _mm_store_ps(slots + 2 * stride, _mm_movelh_ps(xy_last, z0_last));
    _mm_store_ps(slots + 3 * stride, _mm_movehl_ps(z0_last, xy_last));
  }
};

template <std::size_t stride>
struct CornerScatter<LanePack<xsimd::batch<double>>, stride> {
  static void scatter(const Vector3<LanePack<xsimd::batch<double>>>& value, double* slots) {
    const __m128d x = value[0].lanes();
    const __m128d y = value[1].lanes();
    const __m128d z = value[2].lanes();
    const __m128d none = _mm_setzero_pd();
    _mm_store_pd(slots, _mm_unpacklo_pd(x, y));
    _mm_store_pd(slots + 2, _mm_unpacklo_pd(z, none));
    _mm_store_pd(slots + stride, _mm_unpackhi_pd(x, y));
    _mm_store_pd(slots + stride + 2, _mm_unpackhi_pd(z, none));
  }
};
#endif

#if defined(__AVX2__) && !defined(__AVX512F__)
template <std::size_t stride>
struct CornerScatter<LanePack<xsimd::batch<float, xsimd::fma3<xsimd::avx2>>>, stride> {
  using T = LanePack<xsimd::batch<float, xsimd::fma3<xsimd::avx2>>>;
  static void scatter(const Vector3<T>& value, float* slots) {
    const __m256 x = value[0].lanes();
    const __m256 y = value[1].lanes();
    const __m256 z = value[2].lanes();
    const __m256 none = _mm256_setzero_ps();
    const __m256 xy = _mm256_unpacklo_ps(x, y);  // x0 y0 x1 y1, and of lanes 4 and 5
    const __m256 xy_last = _mm256_unpackhi_ps(x, y);
    const __m256 z0 = _mm256_unpacklo_ps(z, none);
    const __m256 z0_last = _mm256_unpackhi_ps(z, none);
    const auto store = [&](std::size_t lane, const __m256& rows) {  // of lanes n and n + 4
      _mm_store_ps(slots + stride * lane, _mm256_castps256_ps128(rows));
      _mm_store_ps(slots + stride * (lane + 4), _mm256_extractf128_ps(rows, 1));
    };
    store(0, _mm256_shuffle_ps(xy, z0, 0x44));
    store(1, _mm256_shuffle_ps(xy, z0, 0xee));
    store(2, _mm256_shuffle_ps(xy_last, z0_last, 0x44));
    store(3, _mm256_shuffle_ps(xy_last, z0_last, 0xee));
  }
};

template <std::size_t stride>
struct CornerScatter<LanePack<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>, stride> {
  using T = LanePack<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>;
  static void scatter(const Vector3<T>& value, double* slots) {
    const __m256d x = value[0].lanes();
    const __m256d y = value[1].lanes();
    const __m256d z = value[2].lanes();
    const __m256d none = _mm256_setzero_pd();
    const __m256d xy = _mm256_unpacklo_pd(x, y);  // of lanes 0 and 2
    const __m256d xy_last = _mm256_unpackhi_pd(x, y);
    const __m256d z0 = _mm256_unpacklo_pd(z, none);
    const __m256d z0_last = _mm256_unpackhi_pd(z, none);
    _mm256_store_pd(slots, _mm256_permute2f128_pd(xy, z0, 0x20));
    _mm256_store_pd(slots + stride, _mm256_permute2f128_pd(xy_last, z0_last, 0x20));
    _mm256_store_pd(slots + 2 * stride, _mm256_permute2f128_pd(xy, z0, 0x31));
    _mm256_store_pd(slots + 3 * stride, _mm256_permute2f128_pd(xy_last, z0_last, 0x31));
  }
};
#endif

#if defined(__AVX512F__)
template <std::size_t stride>
struct CornerScatter<LanePack<xsimd::batch<float, xsimd::avx512f>>, stride> {
  using T = LanePack<xsimd::batch<float, xsimd::avx512f>>;
  static void scatter(const Vector3<T>& value, float* slots) {
    const __m512 x = value[0].lanes();
    const __m512 y = value[1].lanes();
    const __m512 z = value[2].lanes();
    const __m512 none = _mm512_setzero_ps();
    const __m512 xy = _mm512_unpacklo_ps(x, y);  // x0 y0 x1 y1, and of lanes 4 and 5, 8 and 9, 12 and 13
    const __m512 xy_last = _mm512_unpackhi_ps(x, y);
    const __m512 z0 = _mm512_unpacklo_ps(z, none);
    const __m512 z0_last = _mm512_unpackhi_ps(z, none);
    const auto store = [&](std::size_t lane, const __m512& rows) {  // of lanes n, n + 4, n + 8, n + 12
      _mm_store_ps(slots + stride * lane, _mm512_castps512_ps128(rows));
      _mm_store_ps(slots + stride * (lane + 4), _mm512_extractf32x4_ps(rows, 1));
      _mm_store_ps(slots + stride * (lane + 8), _mm512_extractf32x4_ps(rows, 2));
      _mm_store_ps(slots + stride * (lane + 12), _mm512_extractf32x4_ps(rows, 3));
    };
    store(0, _mm512_shuffle_ps(xy, z0, 0x44));
    store(1, _mm512_shuffle_ps(xy, z0, 0xee));
    store(2, _mm512_shuffle_ps(xy_last, z0_last, 0x44));
    store(3, _mm512_shuffle_ps(xy_last, z0_last, 0xee));
  }
};

template <std::size_t stride>
struct CornerScatter<LanePack<xsimd::batch<double, xsimd::avx512f>>, stride> {
  using T = LanePack<xsimd::batch<double, xsimd::avx512f>>;
  static void scatter(const Vector3<T>& value, double* slots) {
    const __m512d x = value[0].lanes();
    const __m512d y = value[1].lanes();
    const __m512d z = value[2].lanes();
    const __m512d none = _mm512_setzero_pd();
    const __m512d xy = _mm512_unpacklo_pd(x, y);  // of lanes 0, 2, 4, 6
    const __m512d xy_last = _mm512_unpackhi_pd(x, y);
    const __m512d z0 = _mm512_unpacklo_pd(z, none);
    const __m512d z0_last = _mm512_unpackhi_pd(z, none);
    const auto store = [&](std::size_t lane, const __m512d& rows) {  // of lanes n and n + 2
      _mm256_store_pd(slots + stride * lane, _mm512_castpd512_pd256(rows));
      _mm256_store_pd(slots + stride * (lane + 2), _mm512_extractf64x4_pd(rows, 1));
    };
    store(0, _mm512_permutex2var_pd(xy, _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0), z0));
    store(1, _mm512_permutex2var_pd(xy_last, _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0), z0_last));
    store(4, _mm512_permutex2var_pd(xy, _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4), z0));
    store(5, _mm512_permutex2var_pd(xy_last, _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4), z0_last));
  }
};
#endif

}  // namespace menger::fem::detail
