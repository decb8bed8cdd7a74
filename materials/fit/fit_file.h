#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "materials/fit/fit.h"

namespace menger::materials {

/// A ranking of fits and the data from which it was made.
struct FitReport {
  std::filesystem::path file;        ///< file of the test
  std::string material;              ///< name of the material in the test
  std::string strain_source;         ///< how the strain was measured, if the test states it
  std::vector<std::string> repairs;  ///< the repairs of the record, one sentence each
  StrainRange range;                 ///< what was asked for; the test may end before it
  std::vector<LawFit> ranking;
};

/// Returns the ranking as TOML: one table `fits` per law, the best first, each with a table `law` that read_law reads. If the
/// shear modulus at rest is not positive, the table is called `parameters_of_no_law` instead. `lowest_strain` and
/// `highest_strain` are those of the fitted rows; `range` is what was asked for.
std::string fit_text(const FitReport& report, const TensileTest& test);

/// The first line of a record that silicone_text made.
inline constexpr std::string_view silicone_text_start =
    "# Written by menger fit, which replaces it with the next fit: copy it before you change it.\n";

/// Returns a record of the silicone that was tested, which read_silicone reads. Its range is that of the fitted rows.
/// @param law recommended law, of positive shear modulus at rest
/// Precondition: a fitted row has a strain above 0.
std::string silicone_text(const FitReport& report, const TensileTest& test, const LawFit& law, double density_kg_per_m3);

/// Writes `fits.toml` and `curves.csv` into a folder, each whole or not at all. `curves.csv` holds the strain, the measured
/// stress and the stress of every law at the rows of the range.
/// @throws io::InputError if the folder cannot be written to
void write_fits(const std::filesystem::path& folder, const FitReport& report, const TensileTest& test);

}  // namespace menger::materials
