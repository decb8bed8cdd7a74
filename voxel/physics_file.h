#pragma once

#include <string>

#include "io/toml_document.h"
#include "voxel/parameters.h"

namespace menger::voxel {

/// Reads the physics of a scene or study from its tables; every table and every key may be missing and then keeps its value of
/// `defaults`.
///
/// - `[materials]` youngs_modulus_Pa, density_kg_m3, static_friction, kinetic_friction of both materials;
/// `[materials.material_1]` and
///   `[materials.material_2]` with the same keys for one of them alone
/// - `[damping]` ratios bond, collision, global
/// - `[environment]` gravity_m_s2, floor, stop_rotation_in_static_friction
/// - `[actuation]` mode ("none", "in_phase", "antiphase", "wave"), amplitude, period_s, material_phase (two numbers), wave_axis
/// ("x", "y", "z"),
///   wave_periods_per_body, wave_over_gaps
/// - `[collisions]` exclusion_depth (an integer >= 1 or "off")
/// - `[integration]` time_step_fraction, damping ("increments", "velocity"), number ("float64", "float32"),
/// single_precision_rest_lengths
/// - `[limits]` speed_fraction, strain
///
/// Other keys of `table` are left to the caller, who ends with table.finish().
/// @throws io::InputError with file, key and value if a value is out of the range that its declaration in parameters.h states, or
/// if float32 is asked for together with damping from increments
Physics read_physics(const io::TomlTable& table, const Physics& defaults = {});

/// All values as the TOML that read_physics reads, always in the same order and exact: equal text means equal physics, and
/// reading it gives the same physics back. Serves as the identity of a physics.
std::string physics_text(const Physics& physics);

}  // namespace menger::voxel
