#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "evolution/study/study.h"

namespace menger::evolution {

/// A ground, and on finite elements a silicone, on which the robots of a study walk.
struct Scenario {
  double friction = 0.0;                ///< of the ground, static and kinetic alike
  std::optional<double> loss_factor{};  ///< of the silicone, at the frequency of the study; voxels have none

  bool operator==(const Scenario&) const = default;
};

/// Returns the scenarios of a study: all pairs of its frictions and loss factors, friction by friction; on voxels its frictions
/// alone. None for a study without the table [robust].
std::vector<Scenario> scenarios_of(const Study& study);

/// Returns the study of one scenario: with its friction and loss factor, without the table [robust].
Study in_scenario(const Study& study, const Scenario& scenario);

/// Returns what is special about a scenario, as TOML.
std::string scenario_text(const Scenario& scenario);

}  // namespace menger::evolution
