#include <cmath>
#include <string>

#include "fem/inflation/inflation_study.h"
#include "fem/inflation/inflation_study_words.h"
#include "io/text/number_text.h"
#include "materials/laws/study_law.h"

namespace menger::fem {
namespace {

/// Bulk modulus over shear modulus where none is given: Poisson's ratio 0.490, which is sufficient for the volume of a silicone
/// chamber's wall.
constexpr double default_bulk_factor = 50.0;

/// Returns the note on a law that is not the recommended one.
std::string note_of(const materials::StudyLaw& chosen) {
  return "material: " + std::string(materials::name_of(chosen.law)) + ", number " + std::to_string(chosen.variant) + " of " +
         std::to_string(chosen.count) + " in the record, up to a stretch of " + io::number_text(chosen.largest_stretch) + ": " +
         chosen.source;
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

/// Describes the law of a material, or that of the named silicone.
void describe_law(io::StudyVisitor& visitor, StudyMaterial& material) {
  materials::StudyLaw chosen{.record = {},
                             .law = material.law,
                             .smallest_stretch = material.smallest_stretch,
                             .largest_stretch = material.largest_stretch};
  describe(visitor, chosen);
  material.law = chosen.law;
  material.smallest_stretch = chosen.smallest_stretch;
  material.largest_stretch = chosen.largest_stretch;
  if (visitor.source() != nullptr) material.name = chosen.name();
  if (!chosen.record) return;
  material.silicone = chosen.record->name;
  material.file = chosen.file;
  if (chosen.count > 0) material.notes.push_back(note_of(chosen));
  if (!material.density_kg_per_m3) material.density_kg_per_m3 = chosen.record->data_sheet.density_kg_per_m3;
}

}  // namespace

void describe(io::StudyVisitor& visitor, StudyMaterial& material) {
  std::optional<double> density = material.density_kg_per_m3;
  describe_law(visitor, material);
  std::size_t kind = material.volume.index();
  visitor.word({"volumetric", "Energy function of a change of volume."}, kind, volumetric_words());
  std::optional<double> bulk_modulus_Pa;
  if (const double known = bulk_modulus_of(material.volume); known > 0.0) bulk_modulus_Pa = known;
  visitor.optional_number(
      {"bulk_modulus_Pa", "Bulk modulus: resistance to a change of volume. If not given: 50 shear moduli.", "4e6"},
      bulk_modulus_Pa, io::positive());
  if (const double shear_modulus_Pa = materials::shear_modulus_at_rest_Pa(material.law);
      !bulk_modulus_Pa && shear_modulus_Pa > 0.0) {
    bulk_modulus_Pa = default_bulk_factor * shear_modulus_Pa;
    material.notes.push_back("material: bulk_modulus_Pa = " + io::number_text(*bulk_modulus_Pa) + " is assumed, " +
                             io::number_text(default_bulk_factor) + " shear moduli (" + material.name + ")");
  }
  material.volume = volumetric_law(kind, bulk_modulus_Pa.value_or(0.0));
  visitor.optional_number({"density_kg_per_m3", "Density. If not given: that of the silicone's record.", "1070"}, density,
                          io::positive());
  if (density) material.density_kg_per_m3 = density;
}

}  // namespace menger::fem
