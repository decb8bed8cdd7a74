#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "evolution/archive/run_archive.h"
#include "evolution/archive/run_archive_database.h"
#include "evolution/archive/run_archive_schema.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::evolution {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) { throw io::InputError(file.string() + ": " + reason); }

/// Looks at the first bytes before SQLite does, since it would take any short file for an empty database.
void require_database_header(const fs::path& file) {
  constexpr std::string_view header("SQLite format 3\0", 16);
  std::array<char, header.size()> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  if (std::string_view(begin.data(), begin.size()) != header) refuse(file, "is not an archive of menger: not an SQLite database");
}

void require_same_study(const fs::path& file, std::string_view archived, std::string_view given) {
  if (archived == given) return;
  std::istringstream old_lines{std::string(archived)};
  std::istringstream new_lines{std::string(given)};
  std::string old_line;
  std::string new_line;
  std::string table;
  do {
    old_line.clear();
    new_line.clear();
    std::getline(old_lines, old_line);
    std::getline(new_lines, new_line);
    if (old_line.starts_with('[') && old_line == new_line) table = old_line + " ";
  } while (old_line == new_line && old_lines && new_lines);
  refuse(file, "is the archive of another study: it has " + table + old_line + ", the study has " + table + new_line +
                   "; give this study another archive");
}

}  // namespace

RunArchive RunArchive::open(const fs::path& file, std::string_view study, int generations) {
  // SQLite takes an empty name for a database of its own that vanishes.
  if (file.empty()) throw io::InputError("the archive needs a file name");
  std::error_code unknown;
  if (fs::is_directory(file, unknown)) refuse(file, "cannot be written: it is a folder");
  io::require_writable_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
  io::FileLock lock(file);
  // A process that died while it made the archive leaves nothing, an empty file or an empty database.
  std::error_code missing;
  if (fs::exists(file, missing) && fs::file_size(file, missing) > 0) require_database_header(file);
  try {
    SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    if (!is_empty_database(connection)) {
      require_archive(file, connection);
      require_same_study(file, connection.execAndGet("SELECT resolved FROM study").getString(), study);
    }
    connection.exec("PRAGMA journal_mode = WAL");
    // What is committed survives the death of the process. A power failure may take the last commits, which are then made again,
    // the same; to flush each of them would slow small bodies down by a tenth.
    connection.exec("PRAGMA synchronous = NORMAL");
    is_empty_database(connection) ? create_schema(connection, study, generations) : upgrade(connection);
    RunArchive archive(std::make_unique<Database>(file, std::move(lock), std::move(connection)));
    if (archive.generation_goal() != generations) {
      SQLite::Statement update(archive.database_->connection, "UPDATE study SET generations = ?");
      update.bind(1, generations);
      update.exec();
    }
    return archive;
  } catch (const SQLite::Exception& error) {
    refuse(file, std::string("cannot be used as an archive: ") + error.what());
  }
}

RunArchive RunArchive::open_to_extend(const fs::path& file) {
  std::error_code missing;
  if (!fs::is_regular_file(file, missing)) refuse(file, "there is no such file");
  io::FileLock lock(file);
  require_database_header(file);
  try {
    SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READWRITE);
    require_archive(file, connection);
    connection.exec("PRAGMA journal_mode = WAL");
    upgrade(connection);
    return RunArchive(std::make_unique<Database>(file, std::move(lock), std::move(connection)));
  } catch (const SQLite::Exception& error) {
    refuse(file, std::string("cannot be extended: ") + error.what());
  }
}

RunArchive RunArchive::open_to_read(const fs::path& file) {
  std::error_code missing;
  if (!fs::is_regular_file(file, missing)) refuse(file, "there is no such file");
  require_database_header(file);
  try {
    SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READONLY, 10000);
    require_archive(file, connection);
    // One long read sees one state, whatever another process adds meanwhile.
    connection.exec("BEGIN");
    return RunArchive(std::make_unique<Database>(file, std::nullopt, std::move(connection)));
  } catch (const SQLite::Exception& error) {
    refuse(file, std::string("cannot be read as an archive: ") + error.what());
  }
}

}  // namespace menger::evolution
