#pragma once

#include "evolution/report/generation_summary.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Makes a table with a row per niche of the last generation that has a survivor: the niche, its robot and its fitness.
/// @param run of a search with niches (SearchPlan::map_elites)
io::CsvTable niche_table(const RunView& run);

}  // namespace menger::evolution
