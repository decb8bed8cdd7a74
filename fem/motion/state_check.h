#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "fem/motion/motion_energy.h"

namespace menger::fem {

/// Finds out whether what a file holds can be the state of a body, and keeps the first reason why not.
class StateCheck {
 public:
  /// Empty as long as nothing speaks against the state; "displacements_m has 12 numbers, the body 360".
  [[nodiscard]] const std::string& reason() const { return reason_; }

  StateCheck& expect(bool is_so, std::string_view otherwise) {
    if (reason_.empty() && !is_so) reason_ = otherwise;
    return *this;
  }

  /// Expects so many numbers, all of them finite.
  template <class Numbers>
  StateCheck& numbers(std::string_view name, const Numbers& numbers, std::size_t count) {
    return counts(name, numbers.size(), count).finite(name, numbers);
  }

  StateCheck& counts(std::string_view name, std::size_t found, std::size_t count) {
    return expect(found == count,
                  std::string(name) + " has " + std::to_string(found) + " numbers, the body " + std::to_string(count));
  }

  template <class Numbers>
  StateCheck& finite(std::string_view name, const Numbers& numbers) {
    return expect(std::all_of(numbers.begin(), numbers.end(), [](auto number) { return std::isfinite(number); }),
                  std::string(name) + " holds a number that is not finite");
  }
  StateCheck& finite(std::string_view name, std::initializer_list<double> numbers) {
    return finite<std::initializer_list<double>>(name, numbers);
  }

  StateCheck& work(const MotionWork& work) {
    const auto& [pressure, wall_pressure, gravity, contact, self_contact, friction, viscous, mass_damping] = work;
    return finite("work", {pressure, wall_pressure, gravity, contact, self_contact, friction, viscous, mass_damping});
  }

 private:
  std::string reason_;
};

}  // namespace menger::fem
