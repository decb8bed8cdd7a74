#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "io/study/study_visitor.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/silicone_record.h"

namespace menger::materials {

/// The keys of a law in a table of its own: its name and its parameters.
/// neo_hookean: shear_modulus_Pa; mooney_rivlin: c10_Pa, c01_Pa; yeoh: c10_Pa, c20_Pa, c30_Pa; ogden1 to ogden3: moduli_Pa,
/// exponents and convention ("ogden", W = sum mu/alpha (...), or "abaqus", W = sum 2 mu/alpha^2 (...), which is converted);
/// gent: shear_modulus_Pa, locking_excess; arruda_boyce: shear_modulus_Pa, locking_stretch.
/// The shear modulus at rest must be positive.
void describe(io::StudyVisitor& visitor, HyperelasticLaw& law);

/// A silicone as a study gives it: one of menger, a file, or a law in place.
struct StudyLaw {
  std::optional<SiliconeRecord> record;  ///< of the silicone that was named; nothing for a law in place
  std::filesystem::path file{};          ///< of that record
  std::size_t variant = 1;               ///< which of the record's laws of its name, from 1
  std::size_t count = 0;                 ///< how many of its name the record has; 0: the recommended law
  HyperelasticLaw law{};
  double smallest_stretch = 0.0;  ///< that the law was compared with; 1: never with compression; 0: no range is stated
  double largest_stretch = std::numeric_limits<double>::infinity();
  std::string source{};  ///< of the record's law

  /// For messages: "Dragon Skin 10, yeoh", "a neo_hookean law in place".
  [[nodiscard]] std::string name() const;
};

/// The keys of a silicone in the table of a material: `silicone`, with law_name and law_variant for another law than the
/// recommended one of its record, or a table `law`. Texts have the law. A reader reads the record.
void describe(io::StudyVisitor& visitor, StudyLaw& law);

}  // namespace menger::materials
