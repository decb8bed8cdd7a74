#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "evolution/report/generation_summary.h"
#include "evolution/search/search_judging.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// A row per robot that was judged in the course of a search: by both models, with what the judge said and what it took.
io::CsvTable judgement_table(const RunView& run);

/// A row per generation that began with judging: what is learnt from all robots judged so far (see Discrepancy).
io::CsvTable correction_table(const RunView& run);

/// What a generation took.
struct GenerationCost {
  std::uint64_t voxel_steps = 0;    ///< voxels times steps, of the evaluations that were made for it
  std::uint64_t element_steps = 0;  ///< of judging
};
GenerationCost generation_cost(const RunView& run, int generation);

/// A row per finished generation: its cost in both units, and in voxel-steps what it and all before took together, with the rate
/// of exchange of the study; without judging there are no element-steps.
io::CsvTable cost_table(const RunView& run);

/// A round of judging for people, a line per robot and one for what was learnt.
std::string round_text(const SearchPlan& plan, const JudgingRound& round, const Discrepancy& discrepancy);

/// The judged robot of the largest score by the judge, of equals the first; none if nobody completed.
std::optional<Judgement> best_judged(const RunArchive& archive);

/// What came of judging: the best by the judge, and the costs. Precondition: a plan with judging and a finished generation.
std::string judging_text(const RunView& run);

}  // namespace menger::evolution
