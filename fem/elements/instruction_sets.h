#pragma once

#ifdef __x86_64__

namespace menger::fem::detail {

/// Whether this machine has the instructions of kernels for AVX2 with FMA. The compiler's builtin also checks whether the
/// operating system saves the wide registers.
inline bool has_avx2() { return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0; }

/// The same for AVX-512.
inline bool has_avx512() { return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0; }

}  // namespace menger::fem::detail

#endif
