#pragma once

#include <string>

#include "io/text/toml_document.h"
#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {

/// Reads a law from a TOML table with its name and its parameters; see describe in study_law.h.
/// @throws io::InputError with file, key and value for wrong input, and if the shear modulus at rest is not positive
HyperelasticLaw read_law(const io::TomlTable& table);

/// Returns the lines of a TOML table from which read_law makes the same law.
std::string law_text(const HyperelasticLaw& law);

/// Returns the same text as one line without a line end: "name = ..., ...". Response curves and voxel parameters use it to
/// compare laws.
std::string law_line(const HyperelasticLaw& law);

}  // namespace menger::materials
