#pragma once

#include <string>
#include <vector>

#include "evolution/reevaluation/reevaluation_comparison.h"
#include "evolution/reevaluation/reevaluation_judge.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// What re-evaluating found.
struct ReevaluationFindings {
  std::vector<JudgedDesign> designs;  ///< by rank
  std::vector<RefusedDesign> refused;
  std::size_t distinct = 0;  ///< robots of the archive with a fitness
  std::vector<VariantRun> variants;
  std::vector<Ranking> rankings;
};

/// A row per judged design with both models: status, displacement, direction, speed, cost; ratio, angle, relative error.
/// left_out_m is the horizontal distance before displacement counts, where that is not from the start; is_balanced whether the
/// robot stands by itself. lowest_dz_m is how far the
/// centre came below its start, 0 if never (seen at the records): far below, the body fell over.
io::CsvTable reevaluation_table(const ReevaluationStudy& study, const ReevaluationFindings& findings);

/// A row per design that was in line and cannot be judged, with the reason.
io::CsvTable refused_table(const ReevaluationFindings& findings);

/// A row per design and variant of the judge, and one of the judge itself; surrogate_relative_error is the gap that they are
/// compared with.
io::CsvTable judge_table(const ReevaluationStudy& study, const ReevaluationFindings& findings);

/// A row per set of designs and number: rank correlations with their intervals, agreement of directions, regret.
io::CsvTable ranking_table(const ReevaluationFindings& findings);

/// A design on one clock: the displacements of both models, the surrogate's interpolated to the times of the finite elements,
/// and how far they are apart horizontally, up to where both went.
io::CsvTable trajectory_comparison(const JudgedDesign& design);

/// The findings for people.
std::string findings_text(const ReevaluationStudy& study, const ReevaluationFindings& findings);

}  // namespace menger::evolution
