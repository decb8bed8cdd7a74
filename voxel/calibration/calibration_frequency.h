#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "io/text/csv_table.h"
#include "meshes/load_cases/load_case.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// The displacement amplitude of the middle of a body's end per amplitude of harmonic pressure in all chambers, m/Pa, at one
/// frequency.
struct FrequencyGain {
  double frequency_Hz = 0.0;
  double reference_m_per_Pa = 0.0;           ///< magnitude, from a file
  std::optional<double> surrogate_m_per_Pa;  ///< nothing if the body has no equilibrium, or at a natural frequency
};

/// The end whose motion is computed. A plate holds the body on the opposite side.
enum class BodyEnd {
  tip,  ///< largest x, along x
  top   ///< largest z, along z
};

/// Computes the magnitude of the steady motion of a body's end, undamped, about its equilibrium under a pressure.
///
/// The motion is the solution of (K - omega^2 M) x = b of small_motion, as a mean over the voxels at the end. Added to it are the
/// growth of their half lengths and, at the middle of their walls, of the bulge. @param body only its shape is used, not the kind
/// @param frequencies_Hz >= 0
std::vector<std::optional<double>> harmonic_gains(const SurrogateParameters& parameters, const meshes::LoadCase& body,
                                                  double pressure_Pa, BodyEnd end, std::span<const double> frequencies_Hz);

/// A reference to compare with. Its table has frequency_Hz and either `gain_m_per_Pa` or the real and imaginary part of an
/// observable, COLUMN_real_m_per_Pa and COLUMN_imaginary_m_per_Pa.
struct FrequencyReference {
  std::filesystem::path file;
  std::string column;  ///< COLUMN; empty: gain_m_per_Pa
  meshes::LoadCase body;
  double pressure_Pa = 0.0;
  BodyEnd end = BodyEnd::tip;
};

/// Reads the gains of a reference, without those of the surrogate. Rows without a gain are left out.
/// @throws io::InputError naming file, line and column
std::vector<FrequencyGain> read_frequency_gains(const FrequencyReference& reference);

/// Computes the gains of the surrogate for those of a reference.
void compute_frequency_response(std::vector<FrequencyGain>& gains, const FrequencyReference& reference,
                                const SurrogateParameters& parameters);

/// The gains as a table: frequency_Hz, reference_m_per_Pa, surrogate_m_per_Pa, relative_error.
io::CsvTable frequency_table(const std::vector<FrequencyGain>& gains);

}  // namespace menger::voxel
