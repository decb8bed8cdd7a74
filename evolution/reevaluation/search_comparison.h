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

/// A robot that was evaluated on finite elements, during a search or after it.
struct ComparedRobot {
  std::optional<double> body_lengths;  ///< by finite elements; none if they failed
  double surrogate_body_lengths = 0.0;
  double element_steps = 0.0;
  double total_voxel_steps = 0.0;  ///< cost of the search and of finite elements up to this robot, in voxel-steps
};

/// A search and the results of its robots on finite elements.
struct ComparedSearch {
  std::string name;                   ///< of its folder
  bool is_corrected = false;          ///< finite elements evaluated robots during the search; false: after it
  std::vector<ComparedRobot> robots;  ///< in the order of evaluation: after a search, by the surrogate's rank
  double voxel_steps = 0.0;           ///< of the evaluations on the surrogate
  double element_steps = 0.0;         ///< of the evaluations on finite elements

  /// Returns the best robot by finite elements, which is the outcome of the search; none if all failed.
  [[nodiscard]] std::optional<ComparedRobot> best() const;
};

/// What decides a comparison besides the results.
struct ComparisonOptions {
  double voxel_steps_per_element_step = 2.6;  ///< cost of an element-step in voxel-steps

  /// Budget of finite elements. The first robot that exceeds it does not count, nor do the robots behind it.
  double budget_element_steps = std::numeric_limits<double>::infinity();
};

/// Reads the folder of a search. It has costs.csv (from menger export) and, for a corrected search, reference.csv (from menger
/// export), or, for a search on the surrogate alone, reevaluation.csv (from menger reevaluate).
/// @throws io::InputError if a table is missing, damaged or not in body lengths
ComparedSearch read_compared_search(const std::filesystem::path& folder, const ComparisonOptions& options);

/// Makes a table with a row per search: its kind, its cost in both units and in total, and its outcome.
io::CsvTable comparison_table(const std::vector<ComparedSearch>& searches, const ComparisonOptions& options);

/// Draws two panels: the best result so far against the cost, a line per search; and the outcomes of all searches.
io::Chart comparison_chart(const std::vector<ComparedSearch>& searches);

/// Returns the outcomes as text for people: each search, and the median of each kind.
std::string comparison_text(const std::vector<ComparedSearch>& searches, const ComparisonOptions& options);

}  // namespace menger::evolution
