#include <string_view>
#include <vector>

#include "fem/inflation/inflation_study_file.h"
#include "fem/inflation/inflation_study_words.h"
#include "io/text/number_text.h"
#include "materials/laws/law_file.h"
#include "materials/laws/record_law.h"
#include "materials/laws/silicone_library.h"
#include "materials/laws/silicone_record.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

/// Bulk modulus by shear modulus where none is given: Poisson's ratio 0.490, as far as the volume of a silicone chamber's wall
/// needs.
constexpr double default_bulk_factor = 50.0;

/// What is to be known of a law that is not the recommended one.
std::string note_of(const materials::RecordLaw& chosen) {
  return "material: " + std::string(materials::name_of(chosen.law.law)) + ", number " + std::to_string(chosen.variant) + " of " +
         std::to_string(chosen.count) + " in the record, up to a stretch of " + io::number_text(chosen.law.largest_stretch) +
         ": " + chosen.law.source;
}

VolumetricLaw volumetric_law(std::size_t kind, double bulk_modulus_Pa) {
  switch (kind) {
    case 0:
      return materials::QuadraticVolume{bulk_modulus_Pa};
    case 1:
      return materials::LogSquaredVolume{bulk_modulus_Pa};
    default:
      return materials::SimoTaylorVolume{bulk_modulus_Pa};
  }
}

}  // namespace

StudyMaterial read_study_material(const io::TomlTable& table, const std::function<void(const fs::path&)>& read_input,
                                  std::vector<std::string>& notes) {
  StudyMaterial material;
  if (materials::has_inline_law(table)) {
    if (table.has("record")) throw table.error("record", "a table [law] beside it gives another material: keep one of them");
    material.law = materials::read_law(table.table("law"));
    material.name = "inline " + std::string(materials::name_of(material.law));
  } else {
    const fs::path file = materials::silicone_file(table, "record");
    read_input(file);
    const materials::SiliconeRecord record = materials::read_silicone(file);
    const materials::RecordLaw chosen = materials::choose_law(table, record);
    if (chosen.count > 0) notes.push_back(note_of(chosen));
    const materials::SourcedLaw& law = chosen.law;
    material.law = law.law;
    material.density_kg_per_m3 = record.data_sheet.density_kg_per_m3;
    material.smallest_stretch = law.smallest_stretch;
    material.largest_stretch = law.largest_stretch;
    material.silicone = record.name;
    material.name = record.name + ", " + std::string(materials::name_of(law.law));
  }
  const double shear_modulus_Pa = materials::shear_modulus_at_rest_Pa(material.law);
  const std::size_t kind = table.word_or<std::size_t>("volumetric", 2, volumetric_words());
  auto bulk_modulus_Pa = table.optional_number("bulk_modulus_Pa", io::positive());
  if (!bulk_modulus_Pa) {
    bulk_modulus_Pa = default_bulk_factor * shear_modulus_Pa;
    notes.push_back("material: bulk_modulus_Pa = " + io::number_text(*bulk_modulus_Pa) + " is assumed, " +
                    io::number_text(default_bulk_factor) + " shear moduli (" + material.name + ")");
  }
  material.volume = volumetric_law(kind, *bulk_modulus_Pa);
  if (const auto density = table.optional_number("density_kg_per_m3", io::positive())) material.density_kg_per_m3 = density;
  return material;
}

}  // namespace menger::fem
