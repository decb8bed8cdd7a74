#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {

/// The properties of the cured silicone that the manufacturer states, or that were measured. Computations use the density; a
/// record of one's own mix may leave out the others.
struct DataSheet {
  std::string source;
  double density_kg_per_m3 = 0.0;
  std::string shore_hardness;                      ///< with its scale: "10A", "00-30"; empty if it is not stated
  std::optional<double> modulus_100_percent_Pa{};  ///< nominal stress at a uniaxial stretch of 2
  std::optional<double> tensile_strength_Pa{};
  std::optional<double> elongation_at_break{};  ///< a fraction: 10 means that the length grows by ten times the original length
};

/// A law with its source and the stretches in which it is valid.
struct SourcedLaw {
  HyperelasticLaw law;
  double smallest_stretch = 1.0;  ///< 1 if the law was never compared with compression
  double largest_stretch = 1.0;
  std::string source;
};

/// Returns the laws of the least and of the largest shear modulus at rest. Precondition: there is one at least.
std::pair<SourcedLaw, SourcedLaw> softest_and_stiffest(std::span<const SourcedLaw> laws);

/// A loss factor of small strain at one frequency.
struct LossPoint {
  double tan_delta = 0.0;     ///< loss modulus divided by storage modulus, > 0
  double frequency_Hz = 0.0;  ///< > 0

  bool operator==(const LossPoint&) const = default;
};

/// The damping of the cured silicone in vibration, from a dynamic test at small strain.
struct LossData {
  std::string source;
  double tan_delta = 0.0;             ///< loss modulus divided by storage modulus, > 0
  double frequency_Hz = 0.0;          ///< frequency of the test, > 0; of several the highest
  std::vector<LossPoint> at_lower{};  ///< loss factors at lower frequencies, which ascend

  /// All of them, by ascending frequency.
  [[nodiscard]] std::vector<LossPoint> points() const;
};

/// Returns data of several frequencies. Precondition: there is one at least, and they ascend.
LossData loss_data(std::string source, std::vector<LossPoint> points);

/// The friction that is published of silicones in general, static or kinetic, on dry ground. It depends on the ground, the load
/// and the dust on the silicone, so that it is to be measured on the ground at hand.
struct PublishedFriction {
  std::string source;
  double lowest = 0.0;  ///< coefficient, >= 0
  double highest = 0.0;
};

/// A silicone: a file of materials/data, in which every number has a source.
struct SiliconeRecord {
  std::string name;
  DataSheet data_sheet;
  /// The law with the most reliable stiffness at moderate strain.
  SourcedLaw recommended;
  std::vector<SourcedLaw> others;  ///< fits of tests and published constants: shape of the curve, bounds of the stiffness
  std::optional<LossData> loss;    ///< nothing if damping was not measured
  std::optional<PublishedFriction> friction;  ///< of silicones; that of this one is not measured
  std::vector<std::string> not_measured;      ///< quantities for which no number with a source is known; may be left out
};

/// Reads a record. @throws io::InputError with file, key and value for wrong input; with all keys if several are missing
SiliconeRecord read_silicone(const std::filesystem::path& file);

}  // namespace menger::materials
