#include "evolution/voxel_evaluator.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "io/joined_text.h"
#include "io/number_text.h"
#include "voxel/physics_file.h"
#include "voxel/simulation.h"

namespace menger::evolution {

VoxelEvaluator::VoxelEvaluator(const voxel::Physics& physics, double cell_edge_m, double duration_s)
    : physics_(physics), cell_edge_m_(cell_edge_m), duration_s_(duration_s) {}

Evaluation VoxelEvaluator::evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const {
  const auto start = std::chrono::steady_clock::now();
  voxel::Physics physics = physics_;
  Evaluation evaluation;
  if (physics.surrogate) physics.surrogate->level = level;
  std::optional<voxel::Simulation> built;
  try {
    built.emplace(body, cell_edge_m_, physics);
  } catch (const voxel::OutsideValidity& outside) {
    // Of one body among many that is no wrong input, but a body without a result.
    evaluation.status = io::RunStatus::diverged;
    evaluation.outside_validity = outside.what();
    evaluation.reason = "outside the range of validity: " + evaluation.outside_validity;
    return evaluation;
  }
  voxel::Simulation& simulation = *built;
  const auto from = simulation.centre_of_mass_m();
  evaluation.status = simulation.advance_to(duration_s_, &stop);
  const auto to = simulation.centre_of_mass_m();
  if (evaluation.status == io::RunStatus::completed)
    evaluation.displacement_m = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  if (const auto& divergence = simulation.divergence()) evaluation.reason = voxel::divergence_text(*divergence);
  evaluation.outside_validity = io::joined(simulation.outside_validity(), "; ");
  evaluation.steps = simulation.steps();
  evaluation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return evaluation;
}

std::string VoxelEvaluator::physics() const {
  return "duration_s = " + io::number_text(duration_s_) + "\ncell_edge_m = " + io::number_text(cell_edge_m_) + "\n" +
         voxel::physics_text(physics_);
}

double VoxelEvaluator::cost(const meshes::Polycube& body, int /*level*/) const { return static_cast<double>(body.count()); }

}  // namespace menger::evolution
