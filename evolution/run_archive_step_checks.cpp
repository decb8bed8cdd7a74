#include "evolution/run_archive.h"
#include "evolution/run_archive_database.h"
#include "io/run_status_words.h"

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
    SQLite::Statement query(
        database_->connection,
        "SELECT generation, status, dx_m, dy_m, dz_m, reason, outside_validity, steps, seconds FROM step_check "
        "WHERE design_hash = ? AND level = ? AND physics_hash = ?");
    query.bind(1, key.design_hash);
    query.bind(2, key.level);
    query.bind(3, key.physics_hash);
    if (!query.executeStep()) return std::nullopt;
    ArchivedEvaluation found;
    found.generation = query.getColumn(0).getInt();
    found.result.status = io::run_status_of(query.getColumn(1).getString());
    if (!query.getColumn(2).isNull()) {
      found.result.displacement_m = {query.getColumn(2).getDouble(), query.getColumn(3).getDouble(),
                                     query.getColumn(4).getDouble()};
    }
    found.result.reason = query.getColumn(5).getString();
    found.result.outside_validity = query.getColumn(6).getString();
    found.result.steps = static_cast<std::uint64_t>(query.getColumn(7).getInt64());
    found.result.seconds = query.getColumn(8).getDouble();
    return found;
  });
}

void RunArchive::add_step_check(const EvaluationKey& key, const ArchivedEvaluation& evaluation) {
  database_->guarded("cannot be written", [&] {
    const Evaluation& result = evaluation.result;
    SQLite::Transaction transaction(database_->connection);
    database_->connection.exec(step_check_schema);
    SQLite::Statement insert(database_->connection, "INSERT INTO step_check VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    insert.bind(1, key.design_hash);
    insert.bind(2, key.level);
    insert.bind(3, key.physics_hash);
    insert.bind(4, evaluation.generation);
    insert.bind(5, std::string(io::to_string(result.status)));
    for (int axis = 0; axis < 3; ++axis) {
      if (result.displacement_m) insert.bind(6 + axis, result.displacement_m->at(static_cast<std::size_t>(axis)));
    }
    insert.bind(9, result.reason);
    insert.bind(10, result.outside_validity);
    insert.bind(11, signed_number(result.steps));
    insert.bind(12, result.seconds);
    insert.exec();
    transaction.commit();
  });
}

}  // namespace menger::evolution
