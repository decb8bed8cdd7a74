#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "meshes/load_cases/load_case.h"

namespace menger::meshes {

/// Where a response curve comes from. Without it a curve is refused.
struct CurveProvenance {
  LoadCase load_case;
  std::string silicone;           ///< name of the record
  std::string law;                ///< the hyperelastic law as one line of text
  double shear_modulus_Pa = 0.0;  ///< of small strain
  double density_kg_m3 = 0.0;
  std::string model;  ///< what computed or measured it, for people: "finite elements, Q2/P1, 1 element through the wall"
  double relative_uncertainty = 0.0;  ///< of the ordinates, stated by the maker, > 0; by the largest magnitude of each ordinate
  std::map<std::string, std::string> inputs;        ///< content hashes of the files behind it
  io::RunStatus status = io::RunStatus::completed;  ///< how the path ended that made it
  std::string reason;                               ///< why, if not completed
  std::optional<double> limit_pressure_Pa;          ///< of inflation, where it was found
  std::optional<double> contact_pressure_Pa;        ///< where walls first touch under vacuum
};

/// How a body answered to a load case: a table of response_columns(kind), one row per state.
struct ResponseCurve {
  CurveProvenance provenance;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values;  ///< by column, all of equal length

  [[nodiscard]] std::size_t row_count() const { return values.empty() ? 0 : values.front().size(); }
  /// A column by name. @throws std::out_of_range if there is none
  [[nodiscard]] const std::vector<double>& column(const std::string& name) const;
};

/// Writes NAME.csv (the table) and NAME.toml (the provenance, with the content hash of the table) into a folder, each whole or
/// not at all. @throws io::InputError naming the file
void write_response_curve(const std::filesystem::path& folder, const ResponseCurve& curve);

/// Reads a curve from its .toml; the table lies beside it.
/// @throws io::InputError with file, key or line and value: no provenance, a table that is not the one the provenance was written
/// for, missing, unknown or differently named columns (other units), values that are not finite, no row, abscissae that are not
/// strictly monotone along each run of equal outer abscissae
ResponseCurve read_response_curve(const std::filesystem::path& provenance_file);

}  // namespace menger::meshes
