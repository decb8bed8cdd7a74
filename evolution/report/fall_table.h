#pragma once

#include "evolution/report/generation_summary.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Makes a table with a row per walk whose body fell: the first individual with this body, its generation, its scenario (from 1),
/// what happened, and how far the body got all the same, from start to end. Such a walk has no score.
io::CsvTable fall_table(const RunView& run);

}  // namespace menger::evolution
