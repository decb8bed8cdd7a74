#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// The tables of a search.
struct SearchTables {
  std::string source;  ///< where they come from, relative to the folder of the report
  io::CsvContents generations;
  std::optional<io::CsvContents> lineage;  ///< of the robot below, if a design has a fitness
  std::string lineage_of = "the champion";
  std::string lineage_source{};  ///< as source
  /// How many times as far as its fitness a robot walks: the number of periods if the fitness is the displacement in one, else 1.
  /// None if it is not known: an export does not say.
  std::optional<double> walk_over_fitness{};
  /// The walks of its best robots on finer elements, see confirmation_table; none if the search has none.
  std::optional<io::CsvContents> confirmed{};
  bool is_of_period = false;  ///< whether the fitness is known to be the displacement in a period
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

/// Returns the unit of the fitness, for people: "body lengths in a period of the drive".
std::string fitness_unit(const SearchTables& tables);

/// Returns the name of the column that has the best fitness, which depends on the objective; empty if there is none.
std::string fitness_column(const io::CsvContents& generations);

}  // namespace menger::evolution
