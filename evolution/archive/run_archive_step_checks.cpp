#include "evolution/archive/run_archive.h"
#include "evolution/archive/run_archive_database.h"

namespace menger::evolution {

namespace {

// Made where it is needed, so that the archives of searches without checks stay what they were.
constexpr const char* step_check_schema = R"sql(
CREATE TABLE IF NOT EXISTS step_check (
  design_hash TEXT NOT NULL,
  level INTEGER NOT NULL,
  physics_hash TEXT NOT NULL,
  generation INTEGER NOT NULL,
  status TEXT NOT NULL,
  dx_m REAL, dy_m REAL, dz_m REAL,
  reason TEXT NOT NULL,
  outside_validity TEXT NOT NULL,
  steps INTEGER NOT NULL,
  seconds REAL NOT NULL,
  PRIMARY KEY (design_hash, level, physics_hash)
) WITHOUT ROWID;
)sql";

}  // namespace

std::optional<ArchivedEvaluation> RunArchive::step_check(const EvaluationKey& key) const {
  return database_->guarded("cannot be read", [&]() -> std::optional<ArchivedEvaluation> {
    if (!has_table(database_->connection, "step_check")) return std::nullopt;
    return find_evaluation(database_->connection, "step_check", key);
  });
}

void RunArchive::add_step_check(const EvaluationKey& key, const ArchivedEvaluation& evaluation) {
  database_->guarded("cannot be written", [&] {
    SQLite::Transaction transaction(database_->connection);
    database_->connection.exec(step_check_schema);
    insert_evaluation(database_->connection, "step_check", key, evaluation);
    transaction.commit();
  });
}

}  // namespace menger::evolution
