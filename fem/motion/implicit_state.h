#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fem/motion/motion_energy.h"

namespace menger::fem {

/// What a node on the ground remembers from step to step.
struct GroundNode {
  bool touches = false;
  bool slides = false;
  std::array<double, 2> anchor_m{};    ///< where its stick spring is unloaded, while it touches
  std::array<double, 2> friction_N{};  ///< on the body
};

/// Where a body is and how it moves by implicit dynamics; 3 numbers per local node, ghosts up to date.
struct ImplicitState {
  double time_s = 0.0;
  std::vector<double> displacements_m;
  std::vector<double> velocities_m_per_s;
  std::vector<double> accelerations_m_per_s2{};  ///< of the scheme; empty: those of the forces
  std::vector<GroundNode> ground_nodes{};        ///< empty: none touches
  double next_step_s = 0.0;                      ///< 0: the first
  std::size_t steps = 0;
  std::size_t rejected_steps = 0;
  std::size_t iterations = 0;  ///< of Newton's method
  MotionWork work{};
  std::optional<double> at_start_J{};  ///< see MotionEnergies; nothing: the energy balance begins with this state
};

}  // namespace menger::fem
