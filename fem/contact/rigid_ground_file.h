#pragma once

#include "fem/contact/rigid_ground.h"
#include "io/text/toml_document.h"

namespace menger::fem {

/// Reads a ground: `static_coefficient` and `kinetic_coefficient` (required), `height_m` (0), `stiffness_Pa_per_m`,
/// `regularisation_speed_m_per_s` (0), and a table `directional` with `forward` (two numbers, any length), `backward_factor` and
/// `sideways_factor` (1).
/// @param stiffness_Pa_per_m where the file states none
/// @throws io::InputError for values outside the ranges of RigidGround
RigidGround read_rigid_ground(const io::TomlTable& table, double stiffness_Pa_per_m);

}  // namespace menger::fem
