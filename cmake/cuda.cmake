# Kernels for graphics processors, off unless asked for: all else builds and passes its tests without.
option(MENGER_CUDA "Build what runs on graphics processors: needs CUDA 13 and its compiler, nvcc" OFF)
if(MENGER_CUDA)
  if(NOT CMAKE_CUDA_ARCHITECTURES)
    set(CMAKE_CUDA_ARCHITECTURES 90 CACHE STRING "Compute capabilities to compile for")
  endif()
  enable_language(CUDA)
  find_package(CUDAToolkit 13 REQUIRED)
  set(CMAKE_CUDA_STANDARD 20)
  set(CMAKE_CUDA_STANDARD_REQUIRED ON)
  set(CMAKE_CUDA_EXTENSIONS OFF)
  # Functions of the standard library that are constexpr run on the device, too.
  string(APPEND CMAKE_CUDA_FLAGS " --expt-relaxed-constexpr -Xcompiler=-ffp-contract=off")
endif()

# Adds kernels to the target of a room, where they are built: menger_cuda_sources(menger_fem_walk a.cu).
function(menger_cuda_sources target)
  if(NOT MENGER_CUDA)
    return()
  endif()
  target_sources(${target} PRIVATE ${ARGN})
  target_compile_definitions(${target} PRIVATE MENGER_WITH_CUDA)
endfunction()
