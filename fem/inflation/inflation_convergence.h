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

/// One observable of the last state on one mesh of a sequence. Each mesh splits every element of the one before into eight.
struct ConvergenceRow {
  std::string observable;  ///< named like a column of curves.csv
  int refinement = 0;      ///< counted from the coarsest mesh of the study
  double element_size_m = 0.0;
  std::size_t elements = 0;
  std::size_t unknowns = 0;
  double value = 0.0;
  std::optional<double> change;          ///< from the mesh before
  std::optional<double> observed_order;  ///< log2 of the ratio of the last two changes; empty if they differ in sign
  /// Estimate of the limit, value + change / (2^order - 1); empty without a positive order.
  std::optional<double> richardson_estimate;
};

/// Returns the observables of the last states: plenum volumes and pressures, displacements and stretches of named points, energy.
/// The rows of an observable end at the first mesh whose run did not reach the path parameter of the coarsest one.
/// @param results of the meshes, the coarsest first
std::vector<ConvergenceRow> convergence_rows(const std::vector<InflationResult>& results);

/// Returns a table with one row per observable and mesh. Its columns are the members of ConvergenceRow; cells without a value are
/// empty.
io::CsvTable convergence_table(const std::vector<ConvergenceRow>& rows);

/// Plots the relative difference of each observable from its Richardson estimate over the size of the elements. Without an
/// estimate, the difference is that from its value on the finest mesh, and dashed.
io::PictureOutcome draw_convergence(const std::filesystem::path& file, const std::vector<ConvergenceRow>& rows);

/// Runs a study on its mesh and on `refinements` finer ones, each in `refinement_<n>` of the folder, and writes convergence.csv
/// and convergence.png. It ends with the first run that does not complete. Near re-entrant edges the exact fields are not smooth:
/// orders are observed there, not asserted.
/// @param begun called on every rank before each run
std::vector<InflationResult> run_convergence(const InflationStudy& study, int refinements, const std::filesystem::path& folder,
                                             const InflationOptions& options, const std::function<void(int)>& begun = {});

}  // namespace menger::fem
