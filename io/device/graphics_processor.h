#pragma once

#include <optional>
#include <string>

namespace menger::io {

/// Where steps are taken.
enum class Device {
  cpu,  ///< by the processor that runs the program
  cuda  ///< on a graphics processor
};

/// A graphics processor that CUDA can use.
struct GraphicsProcessor {
  std::string name;
  int multiprocessors = 0;
  double memory_GB = 0.0;
};

/// Returns the graphics processor that runs what is sent to the device; empty if there is none.
std::optional<GraphicsProcessor> graphics_processor();

/// Returns why nothing can run on a graphics processor here, for users: menger was built without CUDA, or CUDA finds none. Empty
/// if it can.
std::string obstacle_to_device();

}  // namespace menger::io
