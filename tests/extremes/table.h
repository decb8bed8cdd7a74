#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/extremes/row.h"

namespace menger::extremes {

/// The start of the line that run_part prints for a row that ended as expected.
inline constexpr std::string_view as_expected = "as expected: ";

/// Runs the rows of a part and writes its table into a folder. It shows progress on the terminal and prints a line per row. With
/// `is_full` it also runs slow rows. The first Ctrl-C ends it after the current row.
/// @return exit code: done; numerical if a row did not end as expected; interrupted
int run_part(const Part& part, bool is_full, const std::filesystem::path& folder);

/// The main function of the program of a part: reads the options --full and -o, then calls run_part.
int part_program(const Part& part, int argc, const char* const* argv);

/// Returns the file that run_part writes: extremes-<part>.csv.
std::filesystem::path part_file(const std::filesystem::path& folder, const std::string& part);

/// Joins the tables of parts in a folder to extremes.csv and extremes.md, and removes them. extremes.md also states how it was
/// made and the number of cases.
/// @param is_full whether slow rows were run as well
/// @throws io::InputError if a table is missing or unreadable
void join_parts(const std::filesystem::path& folder, const std::vector<std::string>& parts, bool is_full);

}  // namespace menger::extremes
