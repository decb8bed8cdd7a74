#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {

/// What the manufacturer states of the cured silicone.
struct DataSheet {
  std::string source;
  double density_kg_per_m3 = 0.0;
  std::string shore_hardness;           ///< with its scale: "10A", "00-30"
  double modulus_100_percent_Pa = 0.0;  ///< nominal stress at a uniaxial stretch of 2
  double tensile_strength_Pa = 0.0;
  double elongation_at_break = 0.0;  ///< a fraction: 10 is ten times the length on top
};

/// A law with where it comes from and where it holds.
struct SourcedLaw {
  HyperelasticLaw law;
  double smallest_stretch = 1.0;  ///< 1 if it was never compared with compression
  double largest_stretch = 1.0;
  std::string source;
};

/// What vibration takes out of the cured silicone, from a dynamic test at small strain.
struct LossData {
  std::string source;
  double tan_delta = 0.0;     ///< loss modulus by storage modulus, > 0
  double frequency_Hz = 0.0;  ///< of the test, > 0
};

/// A silicone: a file of materials/data, in which every number stands under a source.
struct SiliconeRecord {
  std::string name;
  DataSheet data_sheet;
  SourcedLaw recommended;                 ///< stiffness to trust at moderate strain
  std::vector<SourcedLaw> others;         ///< fits of tests and published constants: shape of the curve, bounds of the stiffness
  std::optional<LossData> loss;           ///< nothing where damping was not measured
  std::vector<std::string> not_measured;  ///< quantities for which no number with a source is known
};

/// Reads a record. @throws io::InputError with file, key and value for anything that is none
SiliconeRecord read_silicone(const std::filesystem::path& file);

}  // namespace menger::materials
