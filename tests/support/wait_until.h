#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace menger::test_support {

/// Waits until something has come true, for two minutes at most, so that a test that fails ends. @return whether it has
[[nodiscard]] inline bool wait_until(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace menger::test_support
