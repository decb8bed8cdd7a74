#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/picture/chart.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// A robot that finite elements judged, in the course of a search or after it.
struct ComparedRobot {
  std::optional<double> body_lengths;  ///< by finite elements; none if they failed
  double surrogate_body_lengths = 0.0;
  double element_steps = 0.0;
  double total_voxel_steps = 0.0;  ///< that search and judging have taken once it is judged, in voxel-steps
};

/// A search with what finite elements found of its robots.
struct ComparedSearch {
  std::string name;                   ///< of its folder
  bool is_corrected = false;          ///< judged on the way; else afterwards
  std::vector<ComparedRobot> robots;  ///< in the order in which they were judged, afterwards by the surrogate's rank
  double voxel_steps = 0.0;           ///< of the evaluations
  double element_steps = 0.0;         ///< of judging

  /// The best by finite elements, the outcome of the search; none if all failed.
  [[nodiscard]] std::optional<ComparedRobot> best() const;
};

/// What decides a comparison beside the results.
struct ComparisonOptions {
  double voxel_steps_per_element_step = 2.6;

  /// Robots that no longer fit into this do not count, nor do those behind them.
  double budget_element_steps = std::numeric_limits<double>::infinity();
};

/// Reads a folder with costs.csv and, of a corrected search, judgements.csv (both of menger export), or else reevaluation.csv (of
/// menger reevaluate) of a search on the surrogate alone.
/// @throws io::InputError if a table is missing, damaged or not in body lengths
ComparedSearch read_compared_search(const std::filesystem::path& folder, const ComparisonOptions& options);

/// A row per search: its kind, what it took in both units and together, and its outcome.
io::CsvTable comparison_table(const std::vector<ComparedSearch>& searches, const ComparisonOptions& options);

/// The best so far over the steps taken, a line per search; beside it the outcomes.
io::Chart comparison_chart(const std::vector<ComparedSearch>& searches);

/// The outcomes for people: each search, and the median of either kind.
std::string comparison_text(const std::vector<ComparedSearch>& searches, const ComparisonOptions& options);

}  // namespace menger::evolution
