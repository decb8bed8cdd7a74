#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace menger::io {

/// Where bodies move.
enum class Device {
  cpu,  ///< on the processor that runs the program
  cuda  ///< on a graphics processor, with the help of that one
};

constexpr std::string_view to_string(Device device) { return device == Device::cpu ? "cpu" : "cuda"; }

/// A graphics processor that CUDA can use.
struct GraphicsProcessor {
  std::string name;
  int multiprocessors = 0;
  double memory_bytes = 0.0;
};

/// Returns the graphics processor that runs what is sent to the device; empty if there is none.
std::optional<GraphicsProcessor> graphics_processor();

/// Returns why nothing can run on a graphics processor here, for users: menger was built without CUDA, or CUDA finds none. Empty
/// if it can.
std::string obstacle_to_device();

}  // namespace menger::io
