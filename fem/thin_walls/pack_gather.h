#pragma once

// Nodal values into lanes of registers. Included only by the kernels of an instruction set.

#include "fem/thin_walls/corner_gather.h"
#include "fem/thin_walls/lane_pack.h"

namespace menger::fem::detail {

#if XSIMD_WITH_SSE2 && !defined(__AVX__)
template <std::size_t stride>
struct CornerGather<LanePack<xsimd::batch<float>>, stride> {
  using T = LanePack<xsimd::batch<float>>;
  static Vector3<T> gather(const std::uint32_t* first, const float* values) {
    const __m128 a = _mm_loadu_ps(values + first[0]);
    const __m128 b = _mm_loadu_ps(values + first[stride]);
    const __m128 c = _mm_loadu_ps(values + first[2 * stride]);
    const __m128 d = _mm_loadu_ps(values + first[3 * stride]);
    const __m128 ab = _mm_unpacklo_ps(a, b);  // xa xb ya yb
    const __m128 cd = _mm_unpacklo_ps(c, d);
    const __m128 ab_last = _mm_unpackhi_ps(a, b);
    const __m128 cd_last = _mm_unpackhi_ps(c, d);
    return {T(xsimd::batch<float>(_mm_movelh_ps(ab, cd))), T(xsimd::batch<float>(_mm_movehl_ps(cd, ab))),
            T(xsimd::batch<float>(_mm_movelh_ps(ab_last, cd_last)))};
  }
};

template <std::size_t stride>
struct CornerGather<LanePack<xsimd::batch<double>>, stride> {
  using T = LanePack<xsimd::batch<double>>;
  static Vector3<T> gather(const std::uint32_t* first, const double* values) {
    const __m128d a = _mm_loadu_pd(values + first[0]);
    const __m128d b = _mm_loadu_pd(values + first[stride]);
    const __m128d z = _mm_loadh_pd(_mm_load_sd(values + first[0] + 2), values + first[stride] + 2);
    return {T(xsimd::batch<double>(_mm_unpacklo_pd(a, b))), T(xsimd::batch<double>(_mm_unpackhi_pd(a, b))),
            T(xsimd::batch<double>(z))};
  }
};
#endif

#if defined(__AVX2__) && !defined(__AVX512F__)
template <std::size_t stride>
struct CornerGather<LanePack<xsimd::batch<float, xsimd::fma3<xsimd::avx2>>>, stride> {
  using Batch = xsimd::batch<float, xsimd::fma3<xsimd::avx2>>;
  using T = LanePack<Batch>;
  static Vector3<T> gather(const std::uint32_t* first, const float* values) {
    const auto rows = [&](std::size_t lane) {  // of lanes n and n + 4
      const __m256 low = _mm256_castps128_ps256(_mm_loadu_ps(values + first[stride * lane]));
      return _mm256_insertf128_ps(low, _mm_loadu_ps(values + first[stride * (lane + 4)]), 1);
    };
    const __m256 a = rows(0);
    const __m256 b = rows(1);
    const __m256 c = rows(2);
    const __m256 d = rows(3);
    const __m256 ab = _mm256_unpacklo_ps(a, b);
    const __m256 cd = _mm256_unpacklo_ps(c, d);
    const __m256 ab_last = _mm256_unpackhi_ps(a, b);
    const __m256 cd_last = _mm256_unpackhi_ps(c, d);
    return {T(Batch(_mm256_shuffle_ps(ab, cd, 0x44))), T(Batch(_mm256_shuffle_ps(ab, cd, 0xee))),
            T(Batch(_mm256_shuffle_ps(ab_last, cd_last, 0x44)))};
  }
};

template <std::size_t stride>
struct CornerGather<LanePack<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>, stride> {
  using Batch = xsimd::batch<double, xsimd::fma3<xsimd::avx2>>;
  using T = LanePack<Batch>;
  static Vector3<T> gather(const std::uint32_t* first, const double* values) {
    const __m256d a = _mm256_loadu_pd(values + first[0]);
    const __m256d b = _mm256_loadu_pd(values + first[stride]);
    const __m256d c = _mm256_loadu_pd(values + first[2 * stride]);
    const __m256d d = _mm256_loadu_pd(values + first[3 * stride]);
    const __m256d ab = _mm256_unpacklo_pd(a, b);  // xa xb za zb
    const __m256d cd = _mm256_unpacklo_pd(c, d);
    const __m256d ab_last = _mm256_unpackhi_pd(a, b);  // ya yb, two of no use
    const __m256d cd_last = _mm256_unpackhi_pd(c, d);
    return {T(Batch(_mm256_permute2f128_pd(ab, cd, 0x20))), T(Batch(_mm256_permute2f128_pd(ab_last, cd_last, 0x20))),
            T(Batch(_mm256_permute2f128_pd(ab, cd, 0x31)))};
  }
};
#endif

#if defined(__AVX512F__)
template <std::size_t stride>
struct CornerGather<LanePack<xsimd::batch<float, xsimd::avx512f>>, stride> {
  using Batch = xsimd::batch<float, xsimd::avx512f>;
  using T = LanePack<Batch>;
  static Vector3<T> gather(const std::uint32_t* first, const float* values) {
    const auto rows = [&](std::size_t lane) {  // of lanes n, n + 4, n + 8, n + 12
      __m512 row = _mm512_castps128_ps512(_mm_loadu_ps(values + first[stride * lane]));
      row = _mm512_insertf32x4(row, _mm_loadu_ps(values + first[stride * (lane + 4)]), 1);
      row = _mm512_insertf32x4(row, _mm_loadu_ps(values + first[stride * (lane + 8)]), 2);
      return _mm512_insertf32x4(row, _mm_loadu_ps(values + first[stride * (lane + 12)]), 3);
    };
    const __m512 a = rows(0);
    const __m512 b = rows(1);
    const __m512 c = rows(2);
    const __m512 d = rows(3);
    const __m512 ab = _mm512_unpacklo_ps(a, b);
    const __m512 cd = _mm512_unpacklo_ps(c, d);
    const __m512 ab_last = _mm512_unpackhi_ps(a, b);
    const __m512 cd_last = _mm512_unpackhi_ps(c, d);
    return {T(Batch(_mm512_shuffle_ps(ab, cd, 0x44))), T(Batch(_mm512_shuffle_ps(ab, cd, 0xee))),
            T(Batch(_mm512_shuffle_ps(ab_last, cd_last, 0x44)))};
  }
};

template <std::size_t stride>
struct CornerGather<LanePack<xsimd::batch<double, xsimd::avx512f>>, stride> {
  using Batch = xsimd::batch<double, xsimd::avx512f>;
  using T = LanePack<Batch>;
  static Vector3<T> gather(const std::uint32_t* first, const double* values) {
    const auto rows = [&](std::size_t lane) {  // of lanes n and n + 2
      const __m512d low = _mm512_castpd256_pd512(_mm256_loadu_pd(values + first[stride * lane]));
      return _mm512_insertf64x4(low, _mm256_loadu_pd(values + first[stride * (lane + 2)]), 1);
    };
    const __m512d a = rows(0);
    const __m512d b = rows(1);
    const __m512d c = rows(4);
    const __m512d d = rows(5);
    const __m512d ab = _mm512_unpacklo_pd(a, b);  // x of 0 1, z of 0 1, x of 2 3, z of 2 3
    const __m512d cd = _mm512_unpacklo_pd(c, d);
    const __m512d ab_last = _mm512_unpackhi_pd(a, b);
    const __m512d cd_last = _mm512_unpackhi_pd(c, d);
    return {T(Batch(_mm512_shuffle_f64x2(ab, cd, 0x88))), T(Batch(_mm512_shuffle_f64x2(ab_last, cd_last, 0x88))),
            T(Batch(_mm512_shuffle_f64x2(ab, cd, 0xdd)))};
  }
};
#endif

}  // namespace menger::fem::detail
