#pragma once

#include <string_view>
#include <variant>

#include "materials/laws/arruda_boyce.h"
#include "materials/laws/gent.h"
#include "materials/laws/mooney_rivlin.h"
#include "materials/laws/neo_hookean.h"
#include "materials/laws/ogden.h"
#include "materials/laws/yeoh.h"

namespace menger::materials {

/// Any of the laws, for files and fits. A loop over elements visits it once, outside the loop. The first one is the default.
using HyperelasticLaw = std::variant<NeoHookean, MooneyRivlin, Yeoh, Ogden<1>, Ogden<2>, Ogden<3>, Gent, ArrudaBoyce>;

/// Returns the word for a law in files: "neo_hookean", "mooney_rivlin", "yeoh", "ogden1" to "ogden3", "gent", "arruda_boyce".
std::string_view name_of(const HyperelasticLaw& law);

/// Returns the shear modulus at rest, Pa.
double shear_modulus_at_rest_Pa(const HyperelasticLaw& law);

}  // namespace menger::materials
