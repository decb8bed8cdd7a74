#pragma once

#include <string_view>

namespace menger::evolution {

/// What evaluates the bodies of a search.
enum class Device {
  cpu,  ///< the processor
  cuda  ///< a graphics processor, which takes a whole generation at once
};
constexpr std::string_view to_string(Device device) { return device == Device::cpu ? "cpu" : "cuda"; }

}  // namespace menger::evolution
