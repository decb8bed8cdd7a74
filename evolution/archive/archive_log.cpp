#include "evolution/archive/archive_log.h"

#include <SQLiteCpp/Backup.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <string>
#include <system_error>

#include "evolution/archive/run_archive_schema.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_copy_bytes = 1'000'000'000;

/// SQLite puts the log beside the file that a symbolic link leads to.
fs::path real_file(const fs::path& file) {
  std::error_code error;
  const fs::path real = fs::canonical(file, error);
  return error ? fs::absolute(file) : real;
}

fs::path log_of(const fs::path& file) { return real_file(file) += "-wal"; }
fs::path journal_of(const fs::path& file) { return real_file(file) += "-journal"; }

std::uintmax_t size_or_zero(const fs::path& file) {
  std::error_code missing;
  const std::uintmax_t bytes = fs::file_size(file, missing);
  return missing ? 0 : bytes;
}

[[noreturn]] void refuse_without_permission(const fs::path& file, const fs::path& beside) {
  refuse_archive(file,
                 "was not closed by the process that wrote it, and cannot be read in a folder without permission to write: "
                 "copy it and " +
                     beside.string() + " to another folder");
}

/// Whether the header of a database says that it has a log.
bool is_marked_with_log(const fs::path& file) {
  constexpr std::size_t write_version_place = 18;
  std::array<char, write_version_place + 1> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return begin[write_version_place] == 2;
}

/// Opens the file as it lies there: without locks, without its log, and without a file beside it.
SQLite::Database open_as_it_lies(const fs::path& file) {
  std::string name("file:");
  for (const char c : real_file(file).string()) {
    const bool is_special = c == '%' || c == '?' || c == '#';
    name += is_special ? (c == '%' ? "%25" : c == '?' ? "%3f" : "%23") : std::string(1, c);
  }
  return SQLite::Database(name + "?immutable=1", SQLite::OPEN_READONLY | SQLite::OPEN_URI);
}

/// Whether an error says that SQLite could not make the files that it needs beside the database.
bool needs_files(const SQLite::Exception& error) {
  constexpr int readonly = 8;  // SQLITE_READONLY, SQLITE_IOERR and SQLITE_CANTOPEN
  constexpr int input_or_output = 10;
  constexpr int cannot_open = 14;
  const int code = error.getErrorCode();
  return code == readonly || code == input_or_output || code == cannot_open;
}

SQLite::Database copy_in_memory(SQLite::Database& source) {
  SQLite::Database copy(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  SQLite::Backup backup(copy, source);
  static_cast<void>(backup.executeStep());
  if (backup.getRemainingPageCount() > 0) throw SQLite::Exception("another process is writing to it");
  return copy;
}

SQLite::Database open_with_log(const fs::path& file) {
  try {
    SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READONLY, patience_ms);
    static_cast<void>(is_empty_database(connection));  // the first read opens the log
    return connection;
  } catch (const SQLite::Exception& error) {
    if (!needs_files(error)) throw;
    if (size_or_zero(log_of(file)) > 0) refuse_without_permission(file, log_of(file));
  }
  return open_as_it_lies(file);
}

/// Takes back the change to the file itself that a killed process left half done. SQLite does this from the journal beside it, on
/// the first read of a connection that may write. The journal of a process that lives is left alone.
void take_back_half_a_change(const fs::path& file) {
  if (size_or_zero(journal_of(file)) == 0) return;
  try {
    SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READWRITE, patience_ms);
    static_cast<void>(is_empty_database(connection));
  } catch (const SQLite::Exception& error) {
    if (!needs_files(error)) throw;
    refuse_without_permission(file, journal_of(file));
  }
}

}  // namespace

void begin_log(SQLite::Database& connection) {
  connection.setBusyTimeout(patience_ms);
  connection.exec("PRAGMA journal_mode = WAL");
  // Into the file itself, where it is seen if the log is missing.
  connection.exec("CREATE TABLE IF NOT EXISTS under_way (log INTEGER PRIMARY KEY)");
  connection.exec("PRAGMA wal_checkpoint(PASSIVE)");
}

void end_log(SQLite::Database& connection) noexcept {
  try {
    connection.setBusyTimeout(0);
    connection.exec("DROP TABLE IF EXISTS under_way");
    if (connection.execAndGet("PRAGMA journal_mode = DELETE").getString() == "delete") return;
  } catch (const std::exception&) {  // others read it
  }
  try {
    connection.exec("PRAGMA wal_checkpoint(TRUNCATE)");
  } catch (const std::exception&) {  // the log has everything
  }
}

void require_log(const fs::path& file) {
  std::error_code missing;
  if (!is_marked_with_log(file) || fs::exists(log_of(file), missing)) return;
  SQLite::Database connection = open_as_it_lies(file);
  if (!is_empty_database(connection) && !connection.tableExists("under_way")) return;
  refuse_archive(file, "is only a part of an archive: it was not closed by the process that wrote it, and " +
                           log_of(file).string() + " is missing; copy both files, or choose another archive");
}

SQLite::Database open_for_reading(const fs::path& file) {
  take_back_half_a_change(file);
  require_log(file);
  if (is_marked_with_log(file)) return open_with_log(file);
  SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READONLY, patience_ms);
  if (fs::file_size(file) > largest_copy_bytes) return connection;
  return copy_in_memory(connection);
}

bool can_be_extended(const fs::path& file) {
  return ::access(file.c_str(), W_OK) == 0 && ::access(real_file(file).parent_path().c_str(), W_OK | X_OK) == 0;
}

void distrust(SQLite::Database& connection) {
  connection.exec("PRAGMA trusted_schema = OFF");
  connection.exec("PRAGMA cell_size_check = ON");
}

}  // namespace menger::evolution
