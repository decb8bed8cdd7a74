#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/page/report_page.h"
#include "io/text/csv_table.h"
#include "io/text/toml_document.h"

namespace menger::evolution {

bool has_file(const CommandOutput& output, const char* file);

/// The body of an output, and where it is if that has another name.
std::string heading_of(const CommandOutput& output);

/// The columns of a table whose names end so.
std::vector<std::string> ending_with(const io::CsvContents& table, std::string_view ending);

/// Adds the notes of a result, a sentence each.
void add_notes_of(const io::TomlTable& table, std::vector<std::string>& words);

/// The names of a column without repetition, in the order in which they appear.
std::vector<std::string> distinct(const io::CsvContents& table, const std::string& column);

/// Returns a fraction of a table in per cent, for people.
std::string percent_in(const io::CsvContents& table, std::size_t row, const std::string& column);

/// Shows a column of fractions in per cent.
void show_percent(const io::CsvContents& table, const std::string& column, PageTable& shown);

/// Whether all numbers of a column are 0 or missing.
bool is_nought(const io::CsvContents& table, const std::string& column);

}  // namespace menger::evolution
