#pragma once

#include <string>

#include "io/text/toml_document.h"
#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {

/// A law from a TOML table: `name` as in name_of and the parameters of that law.
///
/// neo_hookean: shear_modulus_Pa; mooney_rivlin: c10_Pa, c01_Pa; yeoh: c10_Pa, c20_Pa, c30_Pa; ogden1 to ogden3: moduli_Pa,
/// exponents and optionally convention = "ogden" (W = sum mu/alpha (...), the default) or "abaqus" (W = sum 2 mu/alpha^2 (...)),
/// which is converted; gent: shear_modulus_Pa, locking_excess; arruda_boyce: shear_modulus_Pa, locking_stretch.
/// @throws io::InputError with file, key and value for anything else, and if the shear modulus at rest is not positive
HyperelasticLaw read_law(const io::TomlTable& table);

/// The lines of a table from which read_law makes the same law.
std::string law_text(const HyperelasticLaw& law);

/// The same as one line without its end, by which response curves and voxel parameters tell laws apart: "name = ..., ...".
std::string law_line(const HyperelasticLaw& law);

}  // namespace menger::materials
