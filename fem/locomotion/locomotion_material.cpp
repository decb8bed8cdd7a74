#include "fem/locomotion/locomotion_material.h"

#include <optional>
#include <string_view>

#include "io/text/number_text.h"
#include "materials/laws/law_parameters.h"

namespace menger::fem {
namespace {

/// Sets the branch or the viscosity of a material whose law is set, and adds a note unless the damping was measured.
void set_damping(const StudySilicone& given, LocomotionMaterial& material, std::vector<std::string>& notes) {
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

void describe_stiffening(io::StudyVisitor& visitor, StudySilicone& silicone) {
  const auto describe_factor = [&] {
    visitor.number({"modulus_factor", "All moduli of the law are multiplied by this factor."}, silicone.modulus_factor,
                   io::positive());
  };
  const auto describe_modulus = [&] {
    double modulus_Pa = silicone.youngs_modulus_Pa.value_or(0.0);
    visitor.number({"youngs_modulus_Pa", "Young's modulus at rest. All moduli of the law are scaled to reach it.", "1.5e5"},
                   modulus_Pa, io::positive());
    silicone.youngs_modulus_Pa = modulus_Pa;
  };
  const bool has_modulus = silicone.youngs_modulus_Pa.has_value();
  visitor.one_of({{"modulus_factor", !has_modulus, [&] { silicone.youngs_modulus_Pa.reset(); }, describe_factor},
                  {"youngs_modulus_Pa", has_modulus, [] {}, describe_modulus}});
}

}  // namespace

materials::HyperelasticLaw stiffened(const materials::HyperelasticLaw& law, double factor) {
  std::vector<double> values;
  for (const auto& [name, value] : materials::parameters_of(law))
    values.push_back(std::string_view(name).ends_with("_Pa") ? factor * value : value);
  return materials::with_parameters(law, values);
}

void describe(io::StudyVisitor& visitor, StudySilicone& silicone) {
  describe(visitor, silicone.law);
  describe_stiffening(visitor, silicone);
  visitor.number({"bulk_modulus_ratio", "Bulk modulus divided by the shear modulus at rest."}, silicone.bulk_modulus_ratio,
                 io::at_least(1.0));
  visitor.optional_number(
      {"density_kg_per_m3", "Density. Needed with a law; with a silicone it replaces the silicone's density.", "1070"},
      silicone.density_kg_per_m3, io::positive());
  visitor.optional_number({"loss_factor", "Loss factor of small shear. It replaces the silicone's loss factor.", "0.1"},
                          silicone.loss_factor, io::non_negative());
  visitor.only_if(silicone.loss_factor.has_value(), "loss_factor", [&] {
    visitor.number({"loss_frequency_Hz", "Frequency of the loss factor.", "30"}, silicone.loss_frequency_Hz, io::positive());
  });
  visitor.optional_word(
      {"damping_model",
       "maxwell: a branch that damps most at one frequency; kelvin_voigt: a viscosity that damps more the faster "
       "the motion is. If not given: maxwell for explicit dynamics. Implicit dynamics has only kelvin_voigt.",
       "\"kelvin_voigt\""},
      silicone.damping_model, {{"maxwell", DampingModel::maxwell}, {"kelvin_voigt", DampingModel::kelvin_voigt}});
  const io::TomlTable* table = visitor.source();
  if (table == nullptr) return;
  silicone.is_ratio_assumed = !table->has("bulk_modulus_ratio");
  if (!silicone.density_kg_per_m3 && !silicone.law.record)
    throw table->missing("density_kg_per_m3", "a law that is given in the study has no density");
}

LocomotionMaterial material_of(StudySilicone& given, DampingModel usual, std::vector<std::string>& notes) {
  if (!given.density_kg_per_m3) given.density_kg_per_m3 = given.law.record->data_sheet.density_kg_per_m3;
  if (!given.damping_model) given.damping_model = usual;
  const materials::HyperelasticLaw& law = given.law.law;
  const double factor = given.youngs_modulus_Pa ? *given.youngs_modulus_Pa / (3.0 * materials::shear_modulus_at_rest_Pa(law))
                                                : given.modulus_factor;
  LocomotionMaterial material{.law = stiffened(law, factor), .branch = {}, .loss = {}, .name = given.law.name()};
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
