#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "meshes/load_cases/load_case.h"

namespace menger::meshes {

/// The provenance of a response curve. A curve without it is refused.
struct CurveProvenance {
  LoadCase load_case;
  std::string silicone;           ///< name of the record
  std::string law;                ///< the hyperelastic law as one line of text
  double shear_modulus_Pa = 0.0;  ///< at small strain
  double density_kg_m3 = 0.0;
  std::string model;  ///< what computed or measured the curve, for people: "finite elements, Q2/P1, 1 element through the wall"
  /// Relative uncertainty of the ordinates as stated by the maker, > 0: relative to the largest magnitude of each ordinate.
  double relative_uncertainty = 0.0;
  std::map<std::string, std::string> inputs;        ///< content hashes of the files from which it was made
  io::RunStatus status = io::RunStatus::completed;  ///< how the path that made the curve ended
  std::string reason;                               ///< the reason, if not completed
  std::optional<double> limit_pressure_Pa;          ///< limit pressure of an inflation, if it was found
  std::optional<double> contact_pressure_Pa;        ///< pressure at which walls first touch under vacuum
};

/// The response of a body to a load case: a table of response_columns(kind), one row per state.
struct ResponseCurve {
  CurveProvenance provenance;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values;  ///< by column, all of the same length

  [[nodiscard]] std::size_t row_count() const { return values.empty() ? 0 : values.front().size(); }
  /// Returns a column by name. @throws std::out_of_range if there is none
  [[nodiscard]] const std::vector<double>& column(const std::string& name) const;
};

/// Writes NAME.csv (the table) and NAME.toml (the provenance, with the content hash of the table) into a folder, each whole or
/// not at all. @throws io::InputError naming the file
void write_response_curve(const std::filesystem::path& folder, const ResponseCurve& curve);

/// Reads a curve from its .toml file. The table is in the .csv file beside it.
/// @throws io::InputError with file, key or line and value if there is no provenance, the table is not the one for which the
/// provenance was written, columns are missing, unknown or differently named (other units), values are not finite, there is no
/// row, or abscissae are not strictly monotone. The second abscissa must be strictly monotone along each run of equal first
/// abscissae.
ResponseCurve read_response_curve(const std::filesystem::path& provenance_file);

}  // namespace menger::meshes
