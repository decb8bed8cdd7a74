#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "io/study/study_visitor.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/silicone_record.h"

namespace menger::materials {

/// Describes the keys of a law in a table of its own: its name and its parameters. The shear modulus at rest must be positive.
///
/// - neo_hookean: shear_modulus_Pa
/// - mooney_rivlin: c10_Pa, c01_Pa
/// - yeoh: c10_Pa, c20_Pa, c30_Pa
/// - ogden1 to ogden3: moduli_Pa, exponents and convention ("ogden", W = sum mu/alpha (...), or "abaqus", W = sum 2 mu/alpha^2
///   (...), which is converted)
/// - gent: shear_modulus_Pa, locking_excess
/// - arruda_boyce: shear_modulus_Pa, locking_stretch
void describe(io::StudyVisitor& visitor, HyperelasticLaw& law);

/// The silicone of a study: a record of menger, a file, or a law written in the study.
struct StudyLaw {
  std::optional<SiliconeRecord> record;  ///< the silicone that was named; nothing for a law written in the study
  std::filesystem::path file{};          ///< file of that record
  std::size_t variant = 1;               ///< number of the law among the record's laws of the same name, from 1
  std::size_t count = 0;                 ///< how many laws of this name the record has; 0: the recommended law is used
  HyperelasticLaw law{};
  /// The smallest stretch with which the law was compared; 1: never with compression; 0: no range is stated.
  double smallest_stretch = 0.0;
  /// The largest stretch with which the law was compared; infinity: no range is stated.
  double largest_stretch = std::numeric_limits<double>::infinity();
  std::string source{};  ///< source of the record's law

  /// Returns the name for messages: "Dragon Skin 10, yeoh", "inline neo_hookean".
  [[nodiscard]] std::string name() const;
};

/// The value of law_name that means the recommended law of a record.
inline constexpr std::string_view recommended_law_name = "recommended";

/// Returns the law of a record that law_name and law_variant of a study mean.
/// @param table with these keys, for messages @throws io::InputError if the record has no such law
SourcedLaw law_in_record(const io::TomlTable& table, const SiliconeRecord& record, const std::string& law_name,
                         std::size_t law_variant);

/// The recommended law of a silicone. @param file of its record
/// @throws io::InputError as read_silicone
StudyLaw recommended_law(const std::filesystem::path& file);

/// Describes the keys of a silicone in the table of a material. Either `silicone`, with law_name and law_variant for a law other
/// than the recommended one of its record, or a table `law`. Texts of a study contain the law itself. A reader reads the record.
void describe(io::StudyVisitor& visitor, StudyLaw& law);

}  // namespace menger::materials
