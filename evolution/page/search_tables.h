#pragma once

#include <optional>
#include <string>

#include "evolution/page/command_outputs.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// The tables of a search.
struct SearchTables {
  std::string source;  ///< where they come from, relative to the folder of the report
  io::CsvContents generations;
  std::optional<io::CsvContents> lineage;  ///< of the champion, if a design has a fitness
};

/// Reads the tables of a search: those that menger export wrote, or those of the archive that menger evolve wrote.
/// @throws io::InputError if they, or the archive, cannot be read
SearchTables read_search_tables(const CommandOutput& output);

/// Returns whether an output of menger export is that of an archive of menger evolve, by the name of the archive.
bool is_of_archive(const CommandOutput& exported, const CommandOutput& evolved);

/// Returns the name of the column that has the best fitness, which depends on the objective; empty if there is none.
std::string fitness_column(const io::CsvContents& generations);

}  // namespace menger::evolution
