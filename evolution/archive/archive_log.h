#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>

namespace menger::evolution {

/// How long menger waits for others who hold a database for a moment, ms.
inline constexpr int patience_ms = 10'000;

/// The write-ahead log of an archive: the file `<archive>-wal`, which has the latest changes while a process writes, and after
/// this process was killed. An archive that is closed has none and is a single file.

/// Starts the log of an archive that is open for writing, and marks the archive: as long as the mark stands, the log belongs to
/// it.
void begin_log(SQLite::Database& connection);

/// Moves everything into the archive itself, ends the log and takes the mark away. While others read the archive, the log stays;
/// the next writer ends it. Never throws.
void end_log(SQLite::Database& connection) noexcept;

/// Refuses an archive whose log is missing: what only the log had would be lost, or a new search begun over it.
/// @throws io::InputError
void require_log(const std::filesystem::path& file);

/// Opens an archive for reading, such that nobody who writes to it meanwhile has to wait.
///
/// An archive that is written keeps the state of the first read for this reader, by its log. One that is closed is copied into
/// memory; only one of more than a gigabyte is read from the disk. An archive in a place where no file can be made is read as it
/// lies there, if it has no log. A change to the file itself that a killed process left half done is taken back first, from
/// `<archive>-journal`.
/// @throws io::InputError if it has a log or a journal that cannot be read there @throws SQLite::Exception
SQLite::Database open_for_reading(const std::filesystem::path& file);

/// Whether results can be added to an archive: whether this process may write to the file and its folder.
bool can_be_extended(const std::filesystem::path& file);

/// Makes a connection distrust the database: its schema calls no functions with effects. See require_archive for triggers and
/// views.
void distrust(SQLite::Database& connection);

}  // namespace menger::evolution
