#pragma once

#include <string>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// The keys of the physics of a scene or study; those that a `[surrogate]` decides are refused beside it.
///
/// `youngs_modulus_Pa`, `density_kg_per_m3` and the two of friction stand for both materials, or in the table of one of them. A
/// reader takes a drive without ramp_s beside a `[surrogate]` that it reads over its first period, since a step of pressure makes
/// a body ring, and gives what the parameters decide its default, so that equal physics compare equal.
void describe(io::StudyVisitor& visitor, Physics& physics);

/// Reads the physics of a scene or study from its tables; every key that is missing keeps its value of `defaults`. Other keys of
/// `table` are left to the caller, who ends with table.finish(). @throws io::InputError with file, key and value
Physics read_physics(const io::TomlTable& table, const Physics& defaults = {});

/// All values as the TOML that read_physics reads, always in the same order and exact: equal text means equal physics, and
/// reading it gives the same physics back. Serves as the identity of a physics.
std::string physics_text(const Physics& physics);

}  // namespace menger::voxel
