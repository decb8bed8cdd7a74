#include "fem/locomotion/locomotion_material.h"

#include <optional>
#include <string_view>

#include "io/text/number_text.h"
#include "materials/laws/law_file.h"
#include "materials/laws/law_parameters.h"
#include "materials/laws/record_law.h"
#include "materials/laws/silicone_library.h"

namespace menger::fem {
namespace {

/// Bulk modulus by shear modulus where none is given, as for inflation: Poisson's ratio 0.490.
constexpr double default_bulk_ratio = 50.0;

double read_stiffening(const io::TomlTable& table, const materials::HyperelasticLaw& law) {
  const double factor = table.number_or("modulus_factor", 1.0, io::positive());
  const auto youngs_modulus_Pa = table.optional_number("youngs_modulus_Pa", io::positive());
  if (!youngs_modulus_Pa) return factor;
  if (table.has("modulus_factor")) throw table.error("youngs_modulus_Pa", "modulus_factor beside it: keep one of them");
  return *youngs_modulus_Pa / (3.0 * materials::shear_modulus_at_rest_Pa(law));
}

/// Damping that the study states itself.
std::optional<materials::LossData> read_loss(const io::TomlTable& table) {
  if (!table.has("loss_factor") && !table.has("loss_frequency_Hz")) return std::nullopt;
  return materials::LossData{.source = "the study",
                             .tan_delta = table.number("loss_factor", io::non_negative()),
                             .frequency_Hz = table.number("loss_frequency_Hz", io::positive())};
}

/// Branch or viscosity of a material that has its law, and how well they are known.
void read_damping(const io::TomlTable& table, DampingModel usual, const std::optional<materials::LossData>& recorded,
                  LocomotionMaterial& material, std::vector<std::string>& notes) {
  const double shear_modulus_Pa = materials::shear_modulus_at_rest_Pa(material.law);
  const std::optional<materials::LossData> stated = read_loss(table);
  material.is_damping_measured = !stated && recorded;
  material.loss = stated ? *stated : recorded.value_or(assumed_silicone_loss());
  material.damping_model = table.word_or<DampingModel>(
      "damping_model", usual, {{"maxwell", DampingModel::maxwell}, {"kelvin_voigt", DampingModel::kelvin_voigt}});
  if (material.damping_model == DampingModel::maxwell)
    material.branch = maxwell_branch(shear_modulus_Pa, material.loss);
  else
    material.viscosity_Pa_s = viscosity_Pa_s(shear_modulus_Pa, material.loss);
  if (material.is_damping_measured) return;
  notes.push_back("material: damping is not measured; loss factor " + io::number_text(material.loss.tan_delta) + " at " +
                  io::number_text(material.loss.frequency_Hz) + " Hz, " +
                  (stated ? "stated by the study" : std::string(material.loss.source)) +
                  (material.damping_model == DampingModel::maxwell ? "; a Maxwell branch damps most there"
                                                                   : "; of a viscosity, which damps more the faster the motion"));
}

}  // namespace

materials::HyperelasticLaw stiffened(const materials::HyperelasticLaw& law, double factor) {
  std::vector<double> values;
  for (const auto& [name, value] : materials::parameters_of(law))
    values.push_back(std::string_view(name).ends_with("_Pa") ? factor * value : value);
  return materials::with_parameters(law, values);
}

LocomotionMaterial read_locomotion_material(const io::TomlTable& table, DampingModel usual,
                                            const std::function<void(const std::filesystem::path&)>& read_input,
                                            std::vector<std::string>& notes) {
  LocomotionMaterial material;
  std::optional<materials::LossData> recorded;
  if (materials::has_inline_law(table)) {
    if (table.has("record")) throw table.error("record", "a table [law] beside it gives another material: keep one of them");
    material.law = materials::read_law(table.table("law"));
    material.density_kg_per_m3 = table.number("density_kg_per_m3", io::positive());
    material.name = "inline " + std::string(materials::name_of(material.law));
  } else {
    const std::filesystem::path file = materials::silicone_file(table, "record");
    read_input(file);
    const materials::SiliconeRecord record = materials::read_silicone(file);
    material.law = materials::choose_law(table, record).law.law;
    material.density_kg_per_m3 = table.number_or("density_kg_per_m3", record.data_sheet.density_kg_per_m3, io::positive());
    material.name = record.name + ", " + std::string(materials::name_of(material.law));
    recorded = record.loss;
  }
  material.law = stiffened(material.law, read_stiffening(table, material.law));
  const double shear_modulus_Pa = materials::shear_modulus_at_rest_Pa(material.law);
  material.bulk_modulus_Pa = shear_modulus_Pa * table.number_or("bulk_modulus_ratio", default_bulk_ratio, io::at_least(1.0));
  if (!table.has("bulk_modulus_ratio"))
    notes.push_back("material: bulk_modulus_ratio = " + io::number_text(default_bulk_ratio) + " is assumed");
  read_damping(table, usual, recorded, material, notes);
  return material;
}

}  // namespace menger::fem
