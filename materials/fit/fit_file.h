#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/fit/fit.h"

namespace menger::materials {

/// A ranking with what it was made from.
struct FitReport {
  std::filesystem::path file;        ///< of the test
  std::string material;              ///< as the test names it
  std::string strain_source;         ///< how the strain was measured, if the test says
  std::vector<std::string> repairs;  ///< what was done to the record, in sentences
  StrainRange range;
  std::vector<LawFit> ranking;
};

/// The ranking as TOML: one table `fits` per law, the best first, each with a table `law` that read_law reads. Where the shear
/// modulus at rest is not positive the table is called `parameters_of_no_law`.
std::string fit_text(const FitReport& report);

/// Writes `fits.toml` and `curves.csv` (strain, measured stress and that of every law at the rows of the range) into a folder,
/// each whole or not at all. @throws io::InputError if the folder cannot be written to
void write_fits(const std::filesystem::path& folder, const FitReport& report, const TensileTest& test);

}  // namespace menger::materials
