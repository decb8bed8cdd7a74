#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "evolution/archive/run_archive.h"
#include "io/process/file_lock.h"
#include "io/text/input_error.h"

namespace menger::evolution {

/// The open database of an archive; the lock is let go of after the database is closed.
class RunArchive::Database {
 public:
  Database(std::filesystem::path archive, std::optional<io::FileLock> held, SQLite::Database&& opened)
      : file(std::move(archive)), lock(std::move(held)), connection(std::move(opened)) {}

  std::filesystem::path file;
  std::optional<io::FileLock> lock;
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

/// Whether there is a table; some are made only where they are needed.
bool has_table(const SQLite::Database& connection, const char* name);

/// What was left out of a displacement that does not count from the start; by what names a result: design, level, and the hash of
/// what decides it beside the body.
void insert_left_out(SQLite::Database& connection, const EvaluationKey& key, const std::array<double, 3>& left_out_m);
std::optional<std::array<double, 3>> left_out_m(const SQLite::Database& connection, const EvaluationKey& key);

/// An evaluation in a table that has the columns of `evaluation`; without what was left out.
std::optional<ArchivedEvaluation> find_evaluation(const SQLite::Database& connection, const std::string& table,
                                                  const EvaluationKey& key);
void insert_evaluation(SQLite::Database& connection, const std::string& table, const EvaluationKey& key,
                       const ArchivedEvaluation& evaluation);

/// Adds re-evaluations with their protocols, without a transaction.
void insert_reevaluations(SQLite::Database& connection, std::span<const Reevaluation> reevaluations);

/// A re-evaluation from the columns of a row: design_hash, level, text of the protocol, and all from `variant` on.
Reevaluation read_reevaluation(SQLite::Statement& row, int first_column, const SQLite::Database& connection);

template <class Number>
inline std::int64_t signed_number(Number number) {
  return static_cast<std::int64_t>(number);
}

}  // namespace menger::evolution
