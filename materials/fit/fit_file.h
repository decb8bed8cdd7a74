#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/fit/fit.h"

namespace menger::materials {

/// A ranking of fits and the data from which it was made.
struct FitReport {
  std::filesystem::path file;        ///< file of the test
  std::string material;              ///< name of the material in the test
  std::string strain_source;         ///< how the strain was measured, if the test states it
  std::vector<std::string> repairs;  ///< the repairs of the record, one sentence each
  StrainRange range;
  std::vector<LawFit> ranking;
};

/// Returns the ranking as TOML: one table `fits` per law, the best first, each with a table `law` that read_law reads. If the
/// shear modulus at rest is not positive, the table is called `parameters_of_no_law` instead.
std::string fit_text(const FitReport& report);

/// Writes `fits.toml` and `curves.csv` into a folder, each whole or not at all. `curves.csv` holds the strain, the measured
/// stress and the stress of every law at the rows of the range.
/// @throws io::InputError if the folder cannot be written to
void write_fits(const std::filesystem::path& folder, const FitReport& report, const TensileTest& test);

}  // namespace menger::materials
