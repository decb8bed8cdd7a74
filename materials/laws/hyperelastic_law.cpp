#include "materials/laws/hyperelastic_law.h"

#include <array>

namespace menger::materials {

std::string_view name_of(const HyperelasticLaw& law) {
  static constexpr std::array<std::string_view, std::variant_size_v<HyperelasticLaw>> names{
      "neo_hookean", "mooney_rivlin", "yeoh", "ogden1", "ogden2", "ogden3", "gent", "arruda_boyce"};
  return names[law.index()];
}

double shear_modulus_at_rest_Pa(const HyperelasticLaw& law) {
  return std::visit([](const auto& any) { return any.shear_modulus_at_rest_Pa(); }, law);
}

}  // namespace menger::materials
