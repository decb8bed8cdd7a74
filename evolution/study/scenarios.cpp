#include "evolution/study/scenarios.h"

#include "io/text/number_text.h"

namespace menger::evolution {

std::vector<Scenario> scenarios_of(const Study& study) {
  std::vector<Scenario> all;
  if (!study.robust) return all;
  for (const double friction : study.robust->frictions) {
    if (!uses_elements(study))
      all.push_back({friction, std::nullopt});
    else
      for (const double loss_factor : study.robust->loss_factors) all.push_back({friction, loss_factor});
  }
  return all;
}

Study in_scenario(const Study& study, const Scenario& scenario) {
  Study one = study;
  for (voxel::VoxelMaterial& material : one.physics.materials) {
    material.static_friction = scenario.friction;
    material.kinetic_friction = scenario.friction;
  }
  if (scenario.loss_factor) fem::set_loss_factor(one.silicone.silicone, *scenario.loss_factor);
  one.robust.reset();
  one.search.scenarios = 1;
  one.search.quantile = 0.0;
  return one;
}

std::string scenario_text(const Scenario& scenario) {
  return "friction = " + io::number_text(scenario.friction) +
         (scenario.loss_factor ? ", loss_factor = " + io::number_text(*scenario.loss_factor) : "");
}

}  // namespace menger::evolution
