#include <array>
#include <string>

#include "evolution/archive/run_archive.h"
#include "evolution/archive/run_archive_database.h"
#include "io/text/content_hash.h"

namespace menger::evolution {

namespace {

// Made where they are needed, so that the archives of searches without them stay what they were.
constexpr const char* left_out_schema = R"sql(
CREATE TABLE IF NOT EXISTS left_out (
  design_hash TEXT NOT NULL,
  level INTEGER NOT NULL,
  decided_by_hash TEXT NOT NULL,
  dx_m REAL NOT NULL, dy_m REAL NOT NULL, dz_m REAL NOT NULL,
  PRIMARY KEY (design_hash, level, decided_by_hash)
) WITHOUT ROWID;
)sql";
constexpr const char* judgement_schema = R"sql(
CREATE TABLE IF NOT EXISTS judgement (
  generation INTEGER NOT NULL,
  place INTEGER NOT NULL,
  individual INTEGER NOT NULL,
  form TEXT NOT NULL,
  surrogate REAL NOT NULL,
  score REAL,
  element_steps INTEGER NOT NULL,
  design_hash TEXT NOT NULL,
  level INTEGER NOT NULL,
  protocol_hash TEXT NOT NULL,
  PRIMARY KEY (generation, place)
) WITHOUT ROWID;
)sql";

void insert(SQLite::Statement& row, const Judgement& judgement) {
  row.reset();
  row.clearBindings();
  row.bind(1, judgement.generation);
  row.bind(2, signed_number(judgement.place));
  row.bind(3, signed_number(judgement.individual));
  row.bind(4, judgement.form);
  row.bind(5, judgement.surrogate);
  if (judgement.score) row.bind(6, *judgement.score);
  row.bind(7, signed_number(judgement.element_steps));
  row.bind(8, judgement.found.design_hash);
  row.bind(9, judgement.found.level);
  row.bind(10, io::content_hash(judgement.found.protocol));
  row.exec();
}

}  // namespace

bool has_table(const SQLite::Database& connection, const char* name) { return connection.tableExists(name); }

void insert_left_out(SQLite::Database& connection, const EvaluationKey& key, const std::array<double, 3>& left_out_m) {
  connection.exec(left_out_schema);
  SQLite::Statement row(connection, "INSERT OR REPLACE INTO left_out VALUES (?, ?, ?, ?, ?, ?)");
  row.bind(1, key.design_hash);
  row.bind(2, key.level);
  row.bind(3, key.physics_hash);
  for (int axis = 0; axis < 3; ++axis) row.bind(4 + axis, left_out_m.at(static_cast<std::size_t>(axis)));
  row.exec();
}

std::optional<std::array<double, 3>> left_out_m(const SQLite::Database& connection, const EvaluationKey& key) {
  if (!has_table(connection, "left_out")) return std::nullopt;
  SQLite::Statement query(connection,
                          "SELECT dx_m, dy_m, dz_m FROM left_out WHERE design_hash = ? AND level = ? AND decided_by_hash = ?");
  query.bind(1, key.design_hash);
  query.bind(2, key.level);
  query.bind(3, key.physics_hash);
  if (!query.executeStep()) return std::nullopt;
  return std::array{query.getColumn(0).getDouble(), query.getColumn(1).getDouble(), query.getColumn(2).getDouble()};
}

std::vector<Judgement> RunArchive::judgements() const {
  return database_->guarded("cannot be read", [&] {
    std::vector<Judgement> all;
    const SQLite::Database& connection = database_->connection;
    if (!has_table(connection, "judgement")) return all;
    SQLite::Statement query(connection,
                            "SELECT generation, place, individual, form, surrogate, score, element_steps, design_hash, level, "
                            "protocol.text, variant, duration_s, status, dx_m, dy_m, dz_m, reason, steps, seconds FROM judgement "
                            "JOIN reevaluation USING (design_hash, level, protocol_hash) "
                            "JOIN protocol ON protocol.hash = protocol_hash ORDER BY generation, place");
    while (query.executeStep()) {
      Judgement judgement;
      judgement.generation = query.getColumn(0).getInt();
      judgement.place = static_cast<std::size_t>(query.getColumn(1).getInt64());
      judgement.individual = static_cast<std::uint64_t>(query.getColumn(2).getInt64());
      judgement.form = query.getColumn(3).getString();
      judgement.surrogate = query.getColumn(4).getDouble();
      if (!query.getColumn(5).isNull()) judgement.score = query.getColumn(5).getDouble();
      judgement.element_steps = static_cast<std::uint64_t>(query.getColumn(6).getInt64());
      judgement.found = read_reevaluation(query, 7, connection);
      all.push_back(std::move(judgement));
    }
    return all;
  });
}

void RunArchive::add_judgements(std::span<const Judgement> judgements) {
  database_->guarded("cannot be written", [&] {
    SQLite::Transaction transaction(database_->connection);
    database_->connection.exec(judgement_schema);
    SQLite::Statement row(database_->connection, "INSERT INTO judgement VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    for (const Judgement& judgement : judgements) {
      insert_reevaluations(database_->connection, {&judgement.found, 1});
      insert(row, judgement);
    }
    transaction.commit();
  });
}

}  // namespace menger::evolution
