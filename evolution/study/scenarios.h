#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "evolution/study/study.h"

namespace menger::evolution {

/// A ground and a silicone on which the robots of a study walk.
struct Scenario {
  double friction = 0.0;     ///< of the ground, static and kinetic alike
  double loss_factor = 0.0;  ///< of the silicone, at the frequency of the study

  bool operator==(const Scenario&) const = default;
};

/// Returns the scenarios of a study: all pairs of its frictions and loss factors, friction by friction. None for a study without
/// the table [robust].
std::vector<Scenario> scenarios_of(const Study& study);

/// Returns the study of one scenario: with its friction and loss factor, without the table [robust].
Study in_scenario(const Study& study, const Scenario& scenario);

/// Returns what is special about a scenario, as TOML.
std::string scenario_text(const Scenario& scenario);

}  // namespace menger::evolution
