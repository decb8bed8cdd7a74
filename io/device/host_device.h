#pragma once

/// Marks a function that also runs on a graphics processor. Laws, elements and sweeps are written once, for a number type; with
/// this mark CUDA's compiler makes device code of them, while other compilers do not see it.
#if defined(__CUDACC__)
#define MENGER_HOST_DEVICE __host__ __device__
#else
#define MENGER_HOST_DEVICE
#endif
