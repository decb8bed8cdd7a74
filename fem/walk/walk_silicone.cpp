#include "fem/walk/walk_silicone.h"

#include <optional>
#include <string_view>

#include "fem/walk/walk_input_error.h"
#include "io/text/number_text.h"
#include "materials/laws/law_parameters.h"

namespace menger::fem {
namespace {

/// Sets the branch or the viscosity of a material whose law is set, and adds a note unless the damping was measured.
void set_damping(const WalkSilicone& given, WalkMaterial& material, std::vector<std::string>& notes) {
  const double shear_modulus_Pa = materials::shear_modulus_at_rest_Pa(material.law);
  std::optional<materials::LossData> recorded;
  if (given.law.record) recorded = given.law.record->loss;
  material.is_damping_measured = !given.loss_factor && recorded;
  material.loss = recorded.value_or(assumed_silicone_loss());
  if (given.loss_factor)
    material.loss = {.source = "the study", .tan_delta = *given.loss_factor, .frequency_Hz = given.loss_frequency_Hz};
  if (material.damping_model == DampingModel::maxwell)
    material.branch = maxwell_branch(shear_modulus_Pa, material.loss);
  else
    material.viscosity_Pa_s = viscosity_Pa_s(shear_modulus_Pa, material.loss);
  if (material.is_damping_measured) return;
  notes.push_back("material: damping is not measured; loss factor " + io::number_text(material.loss.tan_delta) + " at " +
                  io::number_text(material.loss.frequency_Hz) + " Hz, " +
                  (given.loss_factor ? "given by the study" : std::string(material.loss.source)) +
                  (material.damping_model == DampingModel::maxwell
                       ? "; it is a Maxwell branch, which damps most at this frequency"
                       : "; it is a viscosity, which damps more the faster the motion is"));
}

}  // namespace

materials::HyperelasticLaw stiffened(const materials::HyperelasticLaw& law, double factor) {
  std::vector<double> values;
  for (const auto& [name, value] : materials::parameters_of(law))
    values.push_back(std::string_view(name).ends_with("_Pa") ? factor * value : value);
  return materials::with_parameters(law, values);
}

WalkMaterial material_of(WalkSilicone& given, DampingModel usual, std::vector<std::string>& notes) {
  if (!given.density_kg_per_m3 && !given.law.record)
    throw WalkInputError("material.density_kg_per_m3", "is missing: a law without a record has no density");
  if (!given.density_kg_per_m3) given.density_kg_per_m3 = given.law.record->data_sheet.density_kg_per_m3;
  if (!given.damping_model) given.damping_model = usual;
  const materials::HyperelasticLaw& law = given.law.law;
  const double factor = given.youngs_modulus_Pa ? *given.youngs_modulus_Pa / (3.0 * materials::shear_modulus_at_rest_Pa(law))
                                                : given.modulus_factor;
  WalkMaterial material{.law = stiffened(law, factor), .branch = {}, .loss = {}, .name = given.law.name()};
  material.density_kg_per_m3 = *given.density_kg_per_m3;
  material.bulk_modulus_Pa = materials::shear_modulus_at_rest_Pa(material.law) * given.bulk_modulus_ratio;
  material.damping_model = *given.damping_model;
  if (given.is_ratio_assumed)
    notes.push_back("material: bulk_modulus_ratio = " + io::number_text(given.bulk_modulus_ratio) + " is assumed");
  set_damping(given, material, notes);
  given.loss_factor = material.loss.tan_delta;
  given.loss_frequency_Hz = material.loss.frequency_Hz;
  return material;
}

}  // namespace menger::fem
