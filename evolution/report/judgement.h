#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolution/report/generation_summary.h"
#include "evolution/report/walks_again.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Returns the fittest survivor of every generation, in the order of generations. One that stays the fittest is there once.
std::vector<FitDesign> champions(const RunView& run);

/// Returns why robots of a search cannot walk as another study says, or an empty text: their walks must be on finite elements,
/// of bodies of the same levels, with cells of the same size.
std::string unusable_judge(const Study& search, const Study& judge);

/// Makes a table with a row per robot and scenario, of the robots whose walks in all scenarios of a study the archive has. So
/// robots of any search are scored alike: `fitness` is that of the search, `score` that of all scenarios here.
/// @param judge the study of the walks, see walk_again
io::CsvTable judgement_table(const Study& judge, std::span<const FitDesign> robots, const RunArchive& archive);

}  // namespace menger::evolution
