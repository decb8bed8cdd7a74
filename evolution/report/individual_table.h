#pragma once

#include "evolution/report/generation_summary.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Makes a table with a row per individual that was born in a finished generation, by id: its parent, its body, its fitness and,
/// for each level of the study, the status and the displacement of its evaluation.
///
/// The fitness is that of the last generation in which it took part; cells are empty where a value is not known, as of
/// evaluations that selection did not need. `age` is that at birth. Of several scenarios the one that decided is shown.
/// Individuals that a surrogate left out have a row without results.
io::CsvTable individual_table(const RunView& run);

}  // namespace menger::evolution
