#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {

std::string_view name_of(const HyperelasticLaw& law) {
  return std::visit([](const auto& any) { return std::string_view(any.name); }, law);
}

double shear_modulus_at_rest_Pa(const HyperelasticLaw& law) {
  return std::visit([](const auto& any) { return any.shear_modulus_at_rest_Pa(); }, law);
}

}  // namespace menger::materials
