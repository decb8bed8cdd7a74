#pragma once

#include <string>
#include <vector>

#include "evolution/reevaluation/reevaluation_comparison.h"
#include "evolution/reevaluation/reference_error.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// The findings of a re-evaluation.
struct ReevaluationFindings {
  std::vector<ReevaluatedDesign> designs;  ///< by rank
  std::vector<RefusedDesign> refused;
  std::size_t distinct = 0;  ///< number of robots of the archive with a fitness
  std::vector<VariantRun> variants;
  std::vector<Ranking> rankings;
};

/// Makes a table with a row per re-evaluated design and both models: status, displacement, direction, speed and cost, and the
/// ratio, angle and relative error between both.
///
/// The columns `..._left_out_m` have the horizontal length of the displacement over the whole time less the one that counts; they
/// are empty if all of it counts. `is_balanced` is whether the robot stands by itself. `..._least_dz_m` is the least height of
/// the centre relative to its start, over all records: 0 or negative. A body with a very low value has fallen over.
io::CsvTable reevaluation_table(const ReevaluationStudy& study, const ReevaluationFindings& findings);

/// Makes a table with a row per design that would have been chosen but cannot be evaluated, with the reason.
io::CsvTable refused_table(const ReevaluationFindings& findings);

/// Makes a table with a row per design and variant of the reference evaluator, and one for the reference evaluator itself.
/// `surrogate_relative_error` is the gap between both models, to compare the changes with.
io::CsvTable variant_table(const ReevaluationStudy& study, const ReevaluationFindings& findings);

/// Makes a table with a row per set of designs and quantity: rank correlations with their intervals, agreement of directions,
/// regret.
io::CsvTable ranking_table(const ReevaluationFindings& findings);

/// Makes a table of the motion of a design in both models, at the times of the finite elements: both displacements (that of the
/// surrogate is interpolated) and the horizontal distance between them. It ends with the shorter of both motions.
io::CsvTable trajectory_comparison(const ReevaluatedDesign& design);

/// Returns the findings as text for people.
std::string findings_text(const ReevaluationStudy& study, const ReevaluationFindings& findings);

}  // namespace menger::evolution
