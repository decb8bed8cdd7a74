#include "fem/device/cuda_step_taker.h"

#include <stdexcept>
#include <string>

#include "fem/device/body_arrays.h"
#include "io/device/graphics_processor.h"
#include "io/text/input_error.h"
#ifdef MENGER_WITH_CUDA
#include "fem/device/cuda_steps.h"
#endif

namespace menger::fem {

std::unique_ptr<StepTaker> cuda_step_taker(const meshes::HexahedralMesh& mesh, const ExplicitBody& body,
                                           const ExplicitBodyOptions& options, const NodalLoads& loads) {
  if (const std::string obstacle = io::obstacle_to_device(); !obstacle.empty()) throw std::runtime_error(obstacle);
  if (const std::string obstacle = obstacle_to_blocks(mesh, options); !obstacle.empty())
    throw io::InputError("this body cannot move on a graphics processor: " + obstacle);
#ifdef MENGER_WITH_CUDA
  if (std::get<ThinWallOptions>(options.elements).precision == Precision::double_precision)
    return std::make_unique<CudaSteps<double>>(mesh, body, options, loads);
  return std::make_unique<CudaSteps<float>>(mesh, body, options, loads);
#else
  static_cast<void>(body);
  static_cast<void>(loads);
  return nullptr;  // there was an obstacle
#endif
}

}  // namespace menger::fem
