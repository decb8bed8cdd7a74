#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evolution/study/study.h"
#include "io/picture/chart.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// A robot of a search that was re-evaluated on finite elements.
struct ComparedRobot {
  std::optional<double> body_lengths;  ///< by the re-evaluation; none if it failed
  double search_body_lengths = 0.0;    ///< in the model of the search
  double element_steps = 0.0;          ///< of the re-evaluation
  double total_voxel_steps = 0.0;      ///< cost of the search and of re-evaluations up to this robot, in voxel-steps
};

/// A search and the results of its robots on finite elements.
struct ComparedSearch {
  std::string name;                                 ///< of its folder
  EvaluationModel model = EvaluationModel::voxels;  ///< of the search, by the steps that it took
  std::vector<ComparedRobot> robots;                ///< in the order of re-evaluation: by their rank in the search
  double voxel_steps = 0.0;                         ///< of the search
  double element_steps = 0.0;                       ///< of the search
  double reevaluation_element_steps = 0.0;          ///< of the re-evaluations
  std::map<std::string, std::string> inputs;        ///< the tables that were read, with the hashes of their contents

  /// Returns the best robot by re-evaluation, which is the outcome of the search; none if all failed.
  [[nodiscard]] std::optional<ComparedRobot> best() const;
};

/// What decides a comparison besides the results.
struct ComparisonOptions {
  double voxel_steps_per_element_step = Budget{}.voxel_steps_per_element_step;  ///< cost of an element-step in voxel-steps

  /// Budget of re-evaluations. The first robot that exceeds it does not count, nor do the robots behind it.
  double budget_element_steps = std::numeric_limits<double>::infinity();
};

/// Reads the folder of a search. It has costs.csv (from menger export) and reevaluation.csv (from menger reevaluate), the latter
/// in a folder `reevaluated` of its own, so that each command keeps its manifest, or beside the former.
/// @throws io::InputError if a table is missing, damaged or not in body lengths
ComparedSearch read_compared_search(const std::filesystem::path& folder, const ComparisonOptions& options);

/// Makes a table with a row per search: its model, its cost in both units and in total, and its outcome.
io::CsvTable comparison_table(const std::vector<ComparedSearch>& searches, const ComparisonOptions& options);

/// Draws two panels: the best result so far against the cost, a line per search; and the outcomes of all searches.
io::Chart comparison_chart(const std::vector<ComparedSearch>& searches);

/// Returns the outcomes as text for people: each search, and the median of each model.
std::string comparison_text(const std::vector<ComparedSearch>& searches, const ComparisonOptions& options);

}  // namespace menger::evolution
