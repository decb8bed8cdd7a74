#include "io/device/graphics_processor.h"

#ifdef MENGER_WITH_CUDA
#include <cuda_runtime_api.h>
#endif

namespace menger::io {

#ifdef MENGER_WITH_CUDA

std::optional<GraphicsProcessor> graphics_processor() {
  int count = 0;
  cudaDeviceProp properties{};
  if (cudaGetDeviceCount(&count) != cudaSuccess || count == 0) return std::nullopt;
  if (cudaGetDeviceProperties(&properties, 0) != cudaSuccess) return std::nullopt;
  return GraphicsProcessor{static_cast<const char*>(properties.name), properties.multiProcessorCount,
                           static_cast<double>(properties.totalGlobalMem)};
}

std::string obstacle_to_device() {
  int count = 0;
  const cudaError_t code = cudaGetDeviceCount(&count);
  if (code != cudaSuccess) return std::string("CUDA finds no graphics processor: ") + cudaGetErrorString(code);
  return count == 0 ? "CUDA finds no graphics processor" : "";
}

#else

std::optional<GraphicsProcessor> graphics_processor() { return std::nullopt; }

std::string obstacle_to_device() { return "this menger was built without CUDA (configure it with -DMENGER_CUDA=ON)"; }

#endif

}  // namespace menger::io
