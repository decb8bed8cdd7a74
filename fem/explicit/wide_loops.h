#pragma once

/// Before a function of plain loops: compiles it for several instruction sets too, of which the program takes the widest that the
/// machine has. Sanitizers do not bear functions that are chosen before the program starts.
#if defined(MENGER_X86_KERNELS) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MENGER_WIDE_LOOPS [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define MENGER_WIDE_LOOPS
#endif
