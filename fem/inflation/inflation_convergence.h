#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/inflation/inflation_run.h"
#include "io/picture/chart.h"
#include "io/text/csv_table.h"

namespace menger::fem {

/// A number of the last state on one mesh of a sequence, each of which splits every element of the one before into eight.
struct ConvergenceRow {
  std::string observable;  ///< as a column of curves.csv
  int refinement = 0;      ///< counted from the coarsest mesh of the study
  double element_size_m = 0.0;
  std::size_t elements = 0;
  std::size_t unknowns = 0;
  double value = 0.0;
  std::optional<double> change;               ///< from the mesh before
  std::optional<double> observed_order;       ///< log2 of the ratio of the last two changes; none if they differ in sign
  std::optional<double> richardson_estimate;  ///< of the limit, value + change / (2^order - 1); none without a positive order
};

/// Observables of the last states: plenum volumes and pressures, displacements and stretches of named points, energy. Sequences
/// are compared only if all of them reached the same path parameter.
/// @param results of the meshes, the coarsest first
std::vector<ConvergenceRow> convergence_rows(const std::vector<InflationResult>& results);

/// One row per observable and mesh, with the members of ConvergenceRow as columns; cells without a value are empty.
io::CsvTable convergence_table(const std::vector<ConvergenceRow>& rows);

/// Relative difference of each observable from its Richardson estimate over the size of the elements; where there is none, from
/// its value on the finest mesh, dashed.
io::PictureOutcome draw_convergence(const std::filesystem::path& file, const std::vector<ConvergenceRow>& rows);

/// Runs a study on its mesh and on `refinements` finer ones, each in `refinement_<n>` of the folder, and writes convergence.csv
/// and convergence.png; it ends with the first run that does not complete. Near re-entrant edges the exact fields are not smooth:
/// there orders are observed and nothing is asserted of them.
/// @param begun called on every rank before each run
std::vector<InflationResult> run_convergence(const InflationStudy& study, int refinements, const std::filesystem::path& folder,
                                             const InflationOptions& options, const std::function<void(int)>& begun = {});

}  // namespace menger::fem
