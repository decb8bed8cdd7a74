#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "evolution/archive_lock.h"
#include "evolution/run_archive.h"
#include "io/input_error.h"

namespace menger::evolution {

/// The open database of an archive; the lock is let go of after the database is closed.
class RunArchive::Database {
 public:
  Database(std::filesystem::path archive, std::optional<ArchiveLock> held, SQLite::Database&& opened)
      : file(std::move(archive)), lock(std::move(held)), connection(std::move(opened)) {}

  std::filesystem::path file;
  std::optional<ArchiveLock> lock;
  mutable SQLite::Database connection;

  /// Calls `work()` and turns an error of the database into an InputError that names the archive.
  template <class Work>
  auto guarded(std::string_view doing, const Work& work) const {
    try {
      return work();
    } catch (const SQLite::Exception& error) {
      throw io::InputError(file.string() + ": " + std::string(doing) + ": " + error.what());
    }
  }
};

template <class Number>
inline std::int64_t signed_number(Number number) {
  return static_cast<std::int64_t>(number);
}

}  // namespace menger::evolution
