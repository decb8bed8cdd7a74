#pragma once

#include <array>
#include <string>
#include <string_view>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// What moves the bodies of a study besides voxels.
struct PhysicsUse {
  /// Whether bodies move as voxels. If not, loads, ground and drive have a meaning, but nothing of the voxels themselves.
  bool has_voxels = true;
  /// Lowest and highest pressure of bodies without `[surrogate]` that chambers drive nevertheless; null: there are none.
  std::array<double, 2>* pressure_Pa = nullptr;
  std::string_view pressure_condition = "[surrogate]";  ///< for people: when there are pressures
  bool brings_pressure = false;                         ///< whether the study that is being read did not drive chambers before
  bool is_identity = false;  ///< leaves out keys that archives of earlier versions do not have, where they have their defaults
};

/// Describes the keys of the physics of a scene or study. Keys that the parameters of a `[surrogate]` decide are refused beside
/// it.
///
/// `youngs_modulus_Pa`, `density_kg_per_m3` and the two friction coefficients hold for both materials, or in the table of one
/// material for that one. If a `[surrogate]` is read and ramp_s is not given, the drive grows over its first period, because a
/// step of pressure makes a body ring. Values that the parameters decide are then set to their defaults, so that equal physics
/// compare equal. The same holds for values of voxels where bodies are not moved as voxels.
void describe(io::StudyVisitor& visitor, Physics& physics, const PhysicsUse& use = {});

/// Reads the physics of a scene or study from its tables. A missing key keeps its value in `defaults`. Other keys of `table` are
/// left to the caller, who ends with table.finish(). @throws io::InputError with file, key and value
Physics read_physics(const io::TomlTable& table, const Physics& defaults = {});

/// Checks that no material slides with more friction than it rests with. @param table from which the physics was read
/// @throws io::InputError naming the key of the file
void check_friction(const io::TomlTable& table, const Physics& physics);

/// The values of a physics as TOML for read_physics, exact and always in the same order, as they identify it in archives. Equal
/// text means equal physics, and reading the text gives the same physics again; beam_moments is there unless it is "published".
std::string physics_text(const Physics& physics);

}  // namespace menger::voxel
