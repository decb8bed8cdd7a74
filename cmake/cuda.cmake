# Kernels for graphics processors, off unless asked for: all else builds and passes its tests without.
option(MENGER_CUDA "Build what runs on graphics processors: needs CUDA 13 and its compiler, nvcc" OFF)
set(MENGER_CUDA_ARCHITECTURES 90 CACHE STRING "Compute capabilities to compile for; 90 is that of Hopper")
if(MENGER_CUDA)
  set(CMAKE_CUDA_ARCHITECTURES ${MENGER_CUDA_ARCHITECTURES})
  enable_language(CUDA)
  find_package(CUDAToolkit 13 REQUIRED)
  # CMake of Debian 12 does not know how nvcc is told to take C++20.
  set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION -std=c++20)
  # Functions of the standard library that are constexpr run on the device, too.
  string(APPEND CMAKE_CUDA_FLAGS " --expt-relaxed-constexpr -Xcompiler=-ffp-contract=off")
endif()

# Adds kernels to the target of a room, where they are built: menger_cuda_sources(menger_fem_walk a.cu).
function(menger_cuda_sources target)
  if(NOT MENGER_CUDA)
    return()
  endif()
  target_sources(${target} PRIVATE ${ARGN})
  set_target_properties(${target} PROPERTIES CUDA_ARCHITECTURES ${MENGER_CUDA_ARCHITECTURES})
endfunction()
