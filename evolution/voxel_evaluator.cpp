#include "evolution/voxel_evaluator.h"

#include <array>
#include <cassert>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "io/joined_text.h"
#include "io/number_text.h"
#include "voxel/physics_file.h"
#include "voxel/simulation.h"

namespace menger::evolution {

namespace {

std::array<double, 3> difference(const std::array<double, 3>& to, const std::array<double, 3>& from) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

}  // namespace

VoxelEvaluator::VoxelEvaluator(const voxel::Physics& physics, double cell_edge_m, double duration_s, double measure_from_s)
    : physics_(physics), cell_edge_m_(cell_edge_m), duration_s_(duration_s), measure_from_s_(measure_from_s) {
  assert(measure_from_s >= 0.0 && measure_from_s < duration_s);
}

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
  const auto start_m = simulation.centre_of_mass_m();
  evaluation.status = simulation.advance_to(measure_from_s_, &stop);
  const auto from_m = simulation.centre_of_mass_m();
  if (evaluation.status == io::RunStatus::completed) evaluation.status = simulation.advance_to(duration_s_, &stop);
  if (evaluation.status == io::RunStatus::completed) {
    evaluation.displacement_m = difference(simulation.centre_of_mass_m(), from_m);
    if (measure_from_s_ > 0.0) evaluation.left_out_m = difference(from_m, start_m);
  }
  if (const auto& divergence = simulation.divergence()) evaluation.reason = voxel::divergence_text(*divergence);
  evaluation.outside_validity = io::joined(simulation.outside_validity(), "; ");
  evaluation.steps = simulation.steps();
  evaluation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return evaluation;
}

std::string VoxelEvaluator::physics() const {
  std::string text = "duration_s = " + io::number_text(duration_s_) + "\n";
  if (measure_from_s_ > 0.0) text += "measure_from_s = " + io::number_text(measure_from_s_) + "\n";
  return text + "cell_edge_m = " + io::number_text(cell_edge_m_) + "\n" + voxel::physics_text(physics_);
}

double VoxelEvaluator::cost(const meshes::Polycube& body, int /*level*/) const { return static_cast<double>(body.count()); }

}  // namespace menger::evolution
