#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evolution/page/command_outputs.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// The tables of a search.
struct SearchTables {
  std::string source;  ///< where they come from, relative to the folder of the report
  io::CsvContents generations;
  std::optional<io::CsvContents> lineage;  ///< of the robot below, if a design has a fitness
  std::string lineage_of = "the champion";
  /// How many periods a walk lasts, where the fitness is the displacement in one of them; none where it is that of the whole
  /// walk, or an export does not say.
  std::optional<double> periods_in_walk{};
};

/// Reads the tables of a search: those that menger export wrote, or those of the archive that menger evolve wrote. Which robot is
/// the champion an export knows, since finer elements may have confirmed another one than the fittest: the lineage is that of the
/// export of the same generations, and if there is none, that of the fittest robot.
/// @param outputs among which the exports of an archive are
/// @throws io::InputError if they, or the archive, cannot be read
SearchTables read_search_tables(const CommandOutput& output, const std::vector<CommandOutput>& outputs);

/// Returns the outputs that stand for searches: all archives, and the exports of archives that are not among the outputs. An
/// export is that of an archive if both have the same study, whatever the files are called.
std::vector<const CommandOutput*> searches_in(const std::vector<CommandOutput>& outputs);

/// Returns the name of the column that has the best fitness, which depends on the objective; empty if there is none.
std::string fitness_column(const io::CsvContents& generations);

}  // namespace menger::evolution
