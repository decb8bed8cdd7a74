#include <array>
#include <map>

#include "evolution/archive/run_archive.h"
#include "evolution/archive/run_archive_database.h"
#include "io/text/content_hash.h"
#include "io/text/run_status_words.h"

namespace menger::evolution {

namespace {

constexpr std::string_view reading = "cannot be read";
constexpr std::string_view writing = "cannot be written";

void insert(SQLite::Statement& row, const Reevaluation& reevaluation, const std::string& protocol_hash) {
  const Evaluation& result = reevaluation.result;
  row.reset();
  row.clearBindings();
  row.bind(1, reevaluation.design_hash);
  row.bind(2, reevaluation.level);
  row.bind(3, protocol_hash);
  row.bind(4, reevaluation.variant);
  row.bind(5, reevaluation.duration_s);
  if (reevaluation.has_result) row.bind(6, std::string(io::to_string(result.status)));
  for (std::size_t axis = 0; axis < 3 && result.displacement_m; ++axis)
    row.bind(7 + static_cast<int>(axis), (*result.displacement_m).at(axis));
  row.bind(10, result.reason);
  row.bind(11, signed_number(result.steps));
  row.bind(12, result.seconds);
  row.exec();
}

}  // namespace

Reevaluation read_reevaluation(SQLite::Statement& row, int first_column, const SQLite::Database& connection) {
  const auto column = [&](int n) { return row.getColumn(first_column + n); };
  Reevaluation found;
  found.design_hash = column(0).getString();
  found.level = column(1).getInt();
  found.protocol = column(2).getString();
  found.variant = column(3).getString();
  found.duration_s = column(4).getDouble();
  found.has_result = !column(5).isNull();
  if (found.has_result) found.result.status = io::run_status_of(column(5).getString());
  if (!column(6).isNull()) found.result.displacement_m = {column(6).getDouble(), column(7).getDouble(), column(8).getDouble()};
  found.result.reason = column(9).getString();
  found.result.steps = static_cast<std::uint64_t>(column(10).getInt64());
  found.result.seconds = column(11).getDouble();
  found.result.left_out_m = left_out_m(connection, {found.design_hash, found.level, io::content_hash(found.protocol)});
  return found;
}

void insert_reevaluations(SQLite::Database& connection, std::span<const Reevaluation> reevaluations) {
  SQLite::Statement protocol(connection, "INSERT OR IGNORE INTO protocol VALUES (?, ?)");
  // A budget or a failure that ended a run says nothing of the robot: what another call found of it stays.
  SQLite::Statement row(connection,
                        "INSERT INTO reevaluation VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?) "
                        "ON CONFLICT (design_hash, level, protocol_hash) DO UPDATE SET variant = excluded.variant, "
                        "duration_s = excluded.duration_s, status = excluded.status, dx_m = excluded.dx_m, dy_m = excluded.dy_m, "
                        "dz_m = excluded.dz_m, reason = excluded.reason, steps = excluded.steps, seconds = excluded.seconds "
                        "WHERE COALESCE(excluded.status, 'stopped') != 'stopped' OR COALESCE(status, 'stopped') = 'stopped'");
  for (const Reevaluation& reevaluation : reevaluations) {
    const std::string hash = io::content_hash(reevaluation.protocol);
    protocol.reset();
    protocol.bind(1, hash);
    protocol.bind(2, reevaluation.protocol);
    protocol.exec();
    insert(row, reevaluation, hash);
    const auto& left_out = reevaluation.result.left_out_m;
    if (left_out) insert_left_out(connection, {reevaluation.design_hash, reevaluation.level, hash}, *left_out);
  }
}

std::vector<FitDesign> RunArchive::fit_designs() const {
  return database_->guarded(reading, [&] {
    SQLite::Statement query(database_->connection,
                            "SELECT MIN(individual.id), individual.phenotype, MAX(contender.fitness) AS best FROM contender "
                            "JOIN individual ON individual.id = contender.id WHERE contender.fitness IS NOT NULL "
                            "GROUP BY individual.phenotype ORDER BY best DESC, MIN(individual.id)");
    std::vector<FitDesign> designs;
    while (query.executeStep()) {
      designs.push_back({.individual = static_cast<std::uint64_t>(query.getColumn(0).getInt64()),
                         .phenotype = phenotype_from_key(query.getColumn(1).getString()),
                         .fitness = query.getColumn(2).getDouble()});
    }
    return designs;
  });
}

std::vector<Reevaluation> RunArchive::reevaluations() const {
  return database_->guarded(reading, [&] {
    std::vector<Reevaluation> all;
    if (!database_->connection.tableExists("reevaluation")) return all;
    SQLite::Statement query(database_->connection,
                            "SELECT design_hash, level, protocol.text, variant, duration_s, status, dx_m, dy_m, dz_m, reason, "
                            "steps, seconds FROM reevaluation JOIN protocol ON protocol.hash = protocol_hash "
                            "ORDER BY design_hash, level, protocol_hash");
    while (query.executeStep()) all.push_back(read_reevaluation(query, 0, database_->connection));
    return all;
  });
}

void RunArchive::add_reevaluations(std::span<const Reevaluation> reevaluations) {
  database_->guarded(writing, [&] {
    SQLite::Transaction transaction(database_->connection);
    insert_reevaluations(database_->connection, reevaluations);
    transaction.commit();
    // Whoever copies the file alone has everything; with readers about it is done when the last of them is gone.
    database_->connection.exec("PRAGMA wal_checkpoint(TRUNCATE)");
  });
}

}  // namespace menger::evolution
