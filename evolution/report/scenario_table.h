#pragma once

#include "evolution/report/generation_summary.h"
#include "evolution/study/study.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Makes a table with a row per scenario of every survivor of the last generation, the fittest survivor first: friction, loss
/// factor and the result. `decides` is 1 in the scenario whose score is the fitness.
/// @param study has scenarios
io::CsvTable scenario_table(const RunView& run, const Study& study);

}  // namespace menger::evolution
