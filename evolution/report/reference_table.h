#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "evolution/report/generation_summary.h"
#include "evolution/search/reference_rounds.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Makes a table with a row per reference evaluation of a search: the scores by both models, the outcome and the cost.
io::CsvTable reference_table(const RunView& run);

/// Makes a table with a row per generation that began with reference evaluations: the correction learnt from all reference
/// evaluations so far (see Discrepancy).
io::CsvTable correction_table(const RunView& run);

/// The cost of a generation.
struct GenerationCost {
  std::uint64_t voxel_steps = 0;    ///< voxels times steps, of the evaluations made for it
  std::uint64_t element_steps = 0;  ///< of its reference evaluations
};

/// Computes the cost of a generation from the archive.
GenerationCost generation_cost(const RunView& run, int generation);

/// Makes a table with a row per finished generation: its voxel-steps, its element-steps, and the total cost in voxel-steps of
/// this and all earlier generations. An element-step costs ReferencePlan::voxel_steps_per_element_step. Without a reference
/// evaluator there are no element-steps.
io::CsvTable cost_table(const RunView& run);

/// Describes a round of reference evaluations for people: a line per robot, and one for the correction learnt.
std::string round_text(const SearchPlan& plan, const ReferenceRound& round, const Discrepancy& discrepancy);

/// Returns the reference evaluation with the largest score, of equals the first; none if none completed.
std::optional<ReferenceEvaluation> best_by_reference(const RunArchive& archive);

/// Describes the outcome of all reference evaluations for people: the best robot by the reference evaluator, and the costs.
/// Precondition: run.plan.reference exists and there is a finished generation.
std::string reference_summary(const RunView& run);

}  // namespace menger::evolution
