#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace menger::test_support {

/// Returns all rows of all tables of an archive as text, sorted by their values, without the columns named `seconds`.
inline std::string archive_content(const std::filesystem::path& file) {
  SQLite::Database database(file.string(), SQLite::OPEN_READONLY);
  std::vector<std::string> tables;
  SQLite::Statement names(database, "SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name");
  while (names.executeStep()) tables.push_back(names.getColumn(0).getString());
  std::string content;
  for (const std::string& table : tables) {
    std::string columns;
    SQLite::Statement info(database, "SELECT name FROM pragma_table_info(?) WHERE name <> 'seconds' ORDER BY cid");
    info.bind(1, table);
    while (info.executeStep()) columns.append(columns.empty() ? "" : ", ").append(info.getColumn(0).getString());
    content.append(table).append(" (").append(columns).append(")\n");
    std::string query = "SELECT ";
    query.append(columns).append(" FROM ").append(table).append(" ORDER BY ").append(columns);
    SQLite::Statement rows(database, query);
    while (rows.executeStep()) {
      for (int column = 0; column < rows.getColumnCount(); ++column) {
        // The bits are used because the decimals of SQLite drop digits.
        const SQLite::Column value = rows.getColumn(column);
        content += value.isFloat() ? std::to_string(std::bit_cast<std::uint64_t>(value.getDouble())) : value.getString();
        content += '\x1f';
      }
      content += '\n';
    }
  }
  return content;
}

}  // namespace menger::test_support
