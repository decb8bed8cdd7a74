#include "tests/extremes/table.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"
#include "io/process/progress.h"
#include "io/text/csv_table.h"
#include "io/text/whole_file.h"

namespace menger::extremes {

namespace {

const std::vector<std::string> columns{"part", "case", "done", "expected", "happened", "as_expected", "energy_error", "seconds"};

/// Returns a text escaped for a cell of a Markdown table.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '|') result += '\\';
    result += letter == '\n' ? ' ' : letter;
  }
  return result;
}

std::string markdown_row(const io::CsvContents& table, std::size_t row) {
  const auto energy_error = table.optional_number(row, "energy_error");
  return "| " + escaped(table.text(row, "case")) + " | " + escaped(table.text(row, "done")) + " | " +
         escaped(table.text(row, "expected")) + " | " + escaped(table.text(row, "happened")) + " | " +
         (energy_error ? shown(*energy_error, 2) : "") + " | " + shown(table.number(row, "seconds"), 2) + " |\n";
}

std::string markdown_head(const std::string& part) {
  return "\n## " + part + "\n\n| case | what is done | expected | what happened | energy error | seconds |\n" +
         "| --- | --- | --- | --- | --- | --- |\n";
}

std::string introduction(const std::vector<std::string>& parts, bool is_full, std::size_t as_stated, std::size_t row_count) {
  std::string command = "menger extremes";
  if (parts.size() == 1) command += " --part " + parts[0];
  if (is_full) command += " --full";
  return "# Extremes\n\nEvery case states its outcome beforehand. Written by `" + command + "`" +
         (is_full ? "" : ", without the slow cases") + ": " + std::to_string(as_stated) + " of " + std::to_string(row_count) +
         " cases ended as stated. Energy error: energy that the balance does not explain, by the largest energy of the run.\n";
}

}  // namespace

std::filesystem::path part_file(const std::filesystem::path& folder, const std::string& part) {
  return folder / ("extremes-" + part + ".csv");
}

int run_part(const Part& part, bool is_full, const std::filesystem::path& folder) {
  io::require_writable_folder(folder);
  std::filesystem::remove(part_file(folder, part.name));
  std::vector<Row> rows;
  std::copy_if(part.rows.begin(), part.rows.end(), std::back_inserter(rows),
               [&](const Row& row) { return is_full || !row.is_slow; });
  io::CsvTable table(columns);
  bool all_as_expected = true;
  io::Progress progress("extremes " + part.name, static_cast<double>(rows.size()));
  for (std::size_t n = 0; n < rows.size() && !io::interrupted(); ++n) {
    progress.update(static_cast<double>(n), rows[n].name);
    const RowResult result = run_row(rows[n]);
    table.add_row(part.name, result.name, result.done, result.expected, result.happened, result.is_as_expected ? "yes" : "no",
                  result.energy_error, result.seconds);
    all_as_expected = all_as_expected && result.is_as_expected;
    progress.clear();
    std::cout << (result.is_as_expected ? as_expected : "NOT AS EXPECTED: ") << result.name;
    if (!result.is_as_expected) std::cout << ", expected: " << result.expected << "; happened: " << result.happened;
    std::cout << std::endl;
  }
  table.write(part_file(folder, part.name));
  progress.clear();
  if (io::interrupted()) return io::exit_code::interrupted;
  return all_as_expected ? io::exit_code::done : io::exit_code::numerical;
}

int part_program(const Part& part, int argc, const char* const* argv) {
  CLI::App app("Runs the extreme cases of one model; `menger extremes` joins the tables.", "menger-extremes-" + part.name);
  bool is_full = false;
  std::filesystem::path folder = "extremes";
  app.add_flag("--full", is_full, "run the slow cases, too");
  app.add_option("-o,--output", folder, "folder of the results (default: extremes)");
  if (const auto code = io::parse_arguments(app, argc, argv)) return *code;
  return run_part(part, is_full, folder);
}

void join_parts(const std::filesystem::path& folder, const std::vector<std::string>& parts, bool is_full) {
  io::CsvTable joined(columns);
  std::string sections;
  std::size_t as_stated = 0;
  for (const std::string& part : parts) {
    const io::CsvContents table = io::read_csv(part_file(folder, part));
    sections += markdown_head(part);
    for (std::size_t row = 0; row < table.row_count(); ++row) {
      joined.add_row(part, table.text(row, "case"), table.text(row, "done"), table.text(row, "expected"),
                     table.text(row, "happened"), table.text(row, "as_expected"), table.optional_number(row, "energy_error"),
                     table.number(row, "seconds"));
      sections += markdown_row(table, row);
      if (table.text(row, "as_expected") == "yes") ++as_stated;
    }
  }
  joined.write(folder / "extremes.csv");
  io::write_whole(folder / "extremes.md", introduction(parts, is_full, as_stated, joined.row_count()) + sections);
  for (const std::string& part : parts) std::filesystem::remove(part_file(folder, part));
}

}  // namespace menger::extremes
