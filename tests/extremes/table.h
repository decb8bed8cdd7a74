#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/extremes/row.h"

namespace menger::extremes {

/// How the line begins that run_part prints of a row that ended as expected.
inline constexpr std::string_view as_expected = "as expected: ";

/// Runs the rows of a part and writes the table of the part into a folder, with progress on the terminal; prints a line per row.
/// `is_full`: slow rows, too. The first Ctrl-C ends it after the row at hand.
/// @return exit code: done, numerical if a row did not end as expected, interrupted
int run_part(const Part& part, bool is_full, const std::filesystem::path& folder);

/// The body of the program of a part: options --full and -o, then run_part.
int part_program(const Part& part, int argc, const char* const* argv);

/// The file that run_part writes: extremes-<part>.csv.
std::filesystem::path part_file(const std::filesystem::path& folder, const std::string& part);

/// Joins the tables of parts in a folder to extremes.csv and extremes.md, which says how it was made and counts the cases, and
/// removes them.
/// @param is_full whether slow rows were run, too @throws io::InputError if one is missing or unreadable
void join_parts(const std::filesystem::path& folder, const std::vector<std::string>& parts, bool is_full);

}  // namespace menger::extremes
