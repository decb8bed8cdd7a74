#pragma once

#include <string>

#include "io/text/toml_document.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Reads the physics of a scene or study from its tables; every table and every key may be missing and then keeps its value of
/// `defaults`.
///
/// - `[materials]` youngs_modulus_Pa, density_kg_m3, static_friction, kinetic_friction of both materials;
/// `[materials.material_1]` and
///   `[materials.material_2]` with the same keys for one of them alone; `[materials]` lateral_coupling
/// - `[damping]` ratios bond, collision, global
/// - `[environment]` gravity_m_s2, floor, stop_rotation_in_static_friction
/// - `[actuation]` mode ("none", "in_phase", "antiphase", "wave", "hold"), amplitude, period_s, ramp_s, material_phase (two
/// numbers), wave_axis
/// ("x", "y", "z"),
///   wave_periods_per_body, wave_over_gaps
/// - `[collisions]` exclusion_depth (an integer >= 1 or "off")
/// - `[integration]` time_step_fraction, damping ("increments", "velocity"), number ("float64", "float32"),
/// single_precision_rest_lengths, bond_damping ("explicit", "semi-implicit"; only of solid voxels)
/// - `[limits]` speed_fraction, strain
/// - `[surrogate]` parameters (a file of read_surrogate, or its tables), pressure_Pa (lowest and highest), chambers ("single",
///   "per-phase"; those of the fit if not given), outside_range ("refuse", "warn"); wall_thickness_m and silicone, if given, must
///   be those of the parameters. With it ramp_s is period_s if not given, since a step of pressure makes a body ring;
///   youngs_modulus_Pa, density_kg_m3, lateral_coupling, damping.bond and amplitude are refused, because the parameters decide
///   them, and stop_rotation_in_static_friction, because such bodies stand on the feet of their walls.
///
/// Other keys of `table` are left to the caller, who ends with table.finish().
/// @throws io::InputError with file, key and value if a value is out of the range that its declaration in parameters.h states, or
/// if float32 is asked for together with damping from increments
Physics read_physics(const io::TomlTable& table, const Physics& defaults = {});

/// All values as the TOML that read_physics reads (lateral_coupling, ramp_s, bond_damping and [surrogate] where they are in use),
/// always in the same order and exact: equal text means equal physics, and reading it gives the same physics back. Serves as the
/// identity of a physics.
std::string physics_text(const Physics& physics);

}  // namespace menger::voxel
