#pragma once

// Lanes of registers into memory. Included only by the kernels of an instruction set.

#include "fem/thin_walls/corner_scatter.h"
#include "fem/thin_walls/lane_pack.h"

namespace menger::fem::detail {

#if XSIMD_WITH_SSE2 && !defined(__AVX__)
template <>
struct CornerScatter<LanePack<xsimd::batch<float>>> {
  static constexpr std::size_t place(std::size_t lane) { return lane; }

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
    _mm_store_ps(slots + 4, _mm_movehl_ps(z0, xy));
    _mm_store_ps(slots + 8, _mm_movelh_ps(xy_last, z0_last));
    _mm_store_ps(slots + 12, _mm_movehl_ps(z0_last, xy_last));
  }
};

template <>
struct CornerScatter<LanePack<xsimd::batch<double>>> {
  static constexpr std::size_t place(std::size_t lane) { return lane; }

  static void scatter(const Vector3<LanePack<xsimd::batch<double>>>& value, double* slots) {
    const __m128d x = value[0].lanes();
    const __m128d y = value[1].lanes();
    const __m128d z = value[2].lanes();
    const __m128d none = _mm_setzero_pd();
    _mm_store_pd(slots, _mm_unpacklo_pd(x, y));
    _mm_store_pd(slots + 2, _mm_unpacklo_pd(z, none));
    _mm_store_pd(slots + 4, _mm_unpackhi_pd(x, y));
    _mm_store_pd(slots + 6, _mm_unpackhi_pd(z, none));
  }
};
#endif

#if defined(__AVX2__) && !defined(__AVX512F__)
template <>
struct CornerScatter<LanePack<xsimd::batch<float, xsimd::fma3<xsimd::avx2>>>> {
  using T = LanePack<xsimd::batch<float, xsimd::fma3<xsimd::avx2>>>;
  static constexpr std::size_t place(std::size_t lane) { return 2 * (lane % 4) + lane / 4; }

  static void scatter(const Vector3<T>& value, float* slots) {
    const __m256 x = value[0].lanes();
    const __m256 y = value[1].lanes();
    const __m256 z = value[2].lanes();
    const __m256 none = _mm256_setzero_ps();
    const __m256 xy = _mm256_unpacklo_ps(x, y);  // x0 y0 x1 y1, and of lanes 4 and 5
    const __m256 xy_last = _mm256_unpackhi_ps(x, y);
    const __m256 z0 = _mm256_unpacklo_ps(z, none);
    const __m256 z0_last = _mm256_unpackhi_ps(z, none);
    _mm256_store_ps(slots, _mm256_shuffle_ps(xy, z0, 0x44));  // of lanes 0 and 4
    _mm256_store_ps(slots + 8, _mm256_shuffle_ps(xy, z0, 0xee));
    _mm256_store_ps(slots + 16, _mm256_shuffle_ps(xy_last, z0_last, 0x44));
    _mm256_store_ps(slots + 24, _mm256_shuffle_ps(xy_last, z0_last, 0xee));
  }
};

template <>
struct CornerScatter<LanePack<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>> {
  using T = LanePack<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>;
  static constexpr std::size_t place(std::size_t lane) { return lane; }

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
    _mm256_store_pd(slots + 4, _mm256_permute2f128_pd(xy_last, z0_last, 0x20));
    _mm256_store_pd(slots + 8, _mm256_permute2f128_pd(xy, z0, 0x31));
    _mm256_store_pd(slots + 12, _mm256_permute2f128_pd(xy_last, z0_last, 0x31));
  }
};
#endif

#if defined(__AVX512F__)
template <>
struct CornerScatter<LanePack<xsimd::batch<float, xsimd::avx512f>>> {
  using T = LanePack<xsimd::batch<float, xsimd::avx512f>>;
  static constexpr std::size_t place(std::size_t lane) { return 4 * (lane % 4) + lane / 4; }

  static void scatter(const Vector3<T>& value, float* slots) {
    const __m512 x = value[0].lanes();
    const __m512 y = value[1].lanes();
    const __m512 z = value[2].lanes();
    const __m512 none = _mm512_setzero_ps();
    const __m512 xy = _mm512_unpacklo_ps(x, y);  // x0 y0 x1 y1, and of lanes 4 and 5, 8 and 9, 12 and 13
    const __m512 xy_last = _mm512_unpackhi_ps(x, y);
    const __m512 z0 = _mm512_unpacklo_ps(z, none);
    const __m512 z0_last = _mm512_unpackhi_ps(z, none);
    _mm512_store_ps(slots, _mm512_shuffle_ps(xy, z0, 0x44));  // of lanes 0, 4, 8, 12
    _mm512_store_ps(slots + 16, _mm512_shuffle_ps(xy, z0, 0xee));
    _mm512_store_ps(slots + 32, _mm512_shuffle_ps(xy_last, z0_last, 0x44));
    _mm512_store_ps(slots + 48, _mm512_shuffle_ps(xy_last, z0_last, 0xee));
  }
};

template <>
struct CornerScatter<LanePack<xsimd::batch<double, xsimd::avx512f>>> {
  using T = LanePack<xsimd::batch<double, xsimd::avx512f>>;
  static constexpr std::size_t place(std::size_t lane) { return (lane & 4U) + 2 * (lane & 1U) + (lane >> 1U & 1U); }

  static void scatter(const Vector3<T>& value, double* slots) {
    const __m512d x = value[0].lanes();
    const __m512d y = value[1].lanes();
    const __m512d z = value[2].lanes();
    const __m512d none = _mm512_setzero_pd();
    const __m512d xy = _mm512_unpacklo_pd(x, y);  // of lanes 0, 2, 4, 6
    const __m512d xy_last = _mm512_unpackhi_pd(x, y);
    const __m512d z0 = _mm512_unpacklo_pd(z, none);
    const __m512d z0_last = _mm512_unpackhi_pd(z, none);
    const __m512i low = _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0);
    const __m512i high = _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4);
    _mm512_store_pd(slots, _mm512_permutex2var_pd(xy, low, z0));  // of lanes 0 and 2
    _mm512_store_pd(slots + 8, _mm512_permutex2var_pd(xy_last, low, z0_last));
    _mm512_store_pd(slots + 16, _mm512_permutex2var_pd(xy, high, z0));
    _mm512_store_pd(slots + 24, _mm512_permutex2var_pd(xy_last, high, z0_last));
  }
};
#endif

}  // namespace menger::fem::detail
