#pragma once

#include <string>
#include <vector>

#include "evolution/report/generation_summary.h"
#include "evolution/search/step_checking.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Makes a table with a row per elite and level of the generations whose time step was checked: the displacements with the time
/// step of the search and with half of it, the distance between them, and both scores of the robot (the least over its levels).
io::CsvTable step_check_table(const RunView& run);

/// Describes the checks of a generation for people, a line per elite.
std::string step_check_text(const SearchPlan& plan, int generation, const std::vector<CheckedDesign>& checked);

}  // namespace menger::evolution
