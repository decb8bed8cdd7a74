#pragma once

#include <string>

#include "io/text/toml_document.h"
#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {

/// A law from a TOML table with its name and its parameters; see describe in study_law.h.
/// @throws io::InputError with file, key and value for anything else, and if the shear modulus at rest is not positive
HyperelasticLaw read_law(const io::TomlTable& table);

/// The lines of a table from which read_law makes the same law.
std::string law_text(const HyperelasticLaw& law);

/// The same as one line without its end, by which response curves and voxel parameters tell laws apart: "name = ..., ...".
std::string law_line(const HyperelasticLaw& law);

}  // namespace menger::materials
