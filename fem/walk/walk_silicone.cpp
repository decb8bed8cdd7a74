#include "fem/walk/walk_silicone.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "fem/walk/walk_input_error.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"
#include "materials/laws/law_parameters.h"

namespace menger::fem {
namespace {

/// Returns the loss data of the study; nothing if it has none.
std::optional<materials::LossData> stated_loss(const WalkSilicone& given) {
  constexpr const char* source = "given by the study";
  if (given.loss_factors) {
    std::vector<materials::LossPoint> points;
    for (std::size_t n = 0; n < given.loss_factors->size(); ++n)
      points.push_back({(*given.loss_factors)[n], given.loss_frequencies_Hz[n]});
    return materials::loss_data(source, std::move(points));
  }
  if (!given.loss_factor) return std::nullopt;
  return materials::LossData{.source = source, .tan_delta = *given.loss_factor, .frequency_Hz = given.loss_frequency_Hz};
}

std::string text_of(const materials::LossData& loss) {
  std::vector<std::string> points;
  for (const auto& [tan_delta, frequency_Hz] : loss.points())
    points.push_back(io::number_text(tan_delta) + " at " + io::number_text(frequency_Hz) + " Hz");
  return io::joined(points);
}

/// Sets the branches or the viscosity of a material whose law is set, and adds a note unless the damping was measured.
void set_damping(const WalkSilicone& given, WalkMaterial& material, std::vector<std::string>& notes) {
  const double shear_modulus_Pa = materials::shear_modulus_at_rest_Pa(material.law);
  const std::optional<materials::LossData> stated = stated_loss(given);
  std::optional<materials::LossData> recorded;
  if (given.law.record) recorded = given.law.record->loss;
  material.is_damping_measured = !stated && recorded;
  material.loss = stated ? *stated : recorded.value_or(assumed_silicone_loss());
  if (material.damping_model == DampingModel::maxwell)
    material.branches = maxwell_branches(shear_modulus_Pa, material.loss);
  else
    material.viscosity_Pa_s = viscosity_Pa_s(shear_modulus_Pa, material.loss);
  if (material.is_damping_measured) return;
  std::string model = "it is a viscosity, which damps more the faster the motion is";
  if (material.damping_model == DampingModel::maxwell)
    model = material.loss.at_lower.empty() ? "it is a Maxwell branch, which damps most at this frequency"
                                           : "Maxwell branches follow it";
  notes.push_back("material: damping is not measured; loss factor " + text_of(material.loss) + ", " + material.loss.source +
                  "; " + model);
}

/// Writes loss data into what the caller states, so that the study says what it was computed with.
void state(const materials::LossData& loss, WalkSilicone& given) {
  given.loss_frequency_Hz = loss.frequency_Hz;
  if (loss.at_lower.empty()) {
    given.loss_factor = loss.tan_delta;
    return;
  }
  given.loss_factors.emplace();
  given.loss_frequencies_Hz.clear();
  for (const auto& [tan_delta, frequency_Hz] : loss.points()) {
    given.loss_factors->push_back(tan_delta);
    given.loss_frequencies_Hz.push_back(frequency_Hz);
  }
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
  WalkMaterial material{.law = stiffened(law, factor), .loss = {}, .name = given.law.name()};
  material.density_kg_per_m3 = *given.density_kg_per_m3;
  material.bulk_modulus_Pa = materials::shear_modulus_at_rest_Pa(material.law) * given.bulk_modulus_ratio;
  material.damping_model = *given.damping_model;
  if (given.is_ratio_assumed)
    notes.push_back("material: bulk_modulus_ratio = " + io::number_text(given.bulk_modulus_ratio) + " is assumed");
  set_damping(given, material, notes);
  state(material.loss, given);
  return material;
}

void set_loss_factor(WalkSilicone& silicone, double loss_factor) {
  silicone.loss_factor = loss_factor;
  silicone.loss_factors.reset();
  silicone.loss_frequencies_Hz.clear();
}

double stated_loss_factor(const WalkSilicone& silicone) {
  return silicone.loss_factors ? silicone.loss_factors->back() : silicone.loss_factor.value_or(0.0);
}

}  // namespace menger::fem
