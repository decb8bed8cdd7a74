#pragma once

#include <string>
#include <vector>

#include "evolution/page/report_page.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Returns columns of a table of results for people, in their units. @param columns in order; those that the table lacks, or
/// that are empty in all rows, are left out
/// @param file where the whole table is, for the note
PageTable shown_table(const std::string& title, const io::CsvContents& table, const std::vector<std::string>& columns,
                      const std::string& file);

}  // namespace menger::evolution
