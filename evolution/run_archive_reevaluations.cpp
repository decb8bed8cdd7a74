#include <algorithm>
#include <array>
#include <map>

#include "evolution/run_archive.h"
#include "evolution/run_archive_database.h"
#include "io/content_hash.h"

namespace menger::evolution {

namespace {

constexpr std::string_view reading = "cannot be read";
constexpr std::string_view writing = "cannot be written";

constexpr std::array statuses{io::RunStatus::completed,   io::RunStatus::diverged,         io::RunStatus::not_converged,
                              io::RunStatus::limit_point, io::RunStatus::inverted_element, io::RunStatus::wall_contact,
                              io::RunStatus::stopped};

io::RunStatus status_of(const std::string& word) {
  const auto* const found = std::ranges::find_if(statuses, [&](io::RunStatus status) { return io::to_string(status) == word; });
  if (found == statuses.end()) throw io::InputError("\"" + word + "\" is not a status of a run");
  return *found;
}

Reevaluation read_row(SQLite::Statement& row) {
  Reevaluation found;
  found.design_hash = row.getColumn(0).getString();
  found.level = row.getColumn(1).getInt();
  found.protocol = row.getColumn(2).getString();
  found.variant = row.getColumn(3).getString();
  found.duration_s = row.getColumn(4).getDouble();
  found.has_result = !row.getColumn(5).isNull();
  if (found.has_result) found.result.status = status_of(row.getColumn(5).getString());
  if (!row.getColumn(6).isNull())
    found.result.displacement_m = {row.getColumn(6).getDouble(), row.getColumn(7).getDouble(), row.getColumn(8).getDouble()};
  found.result.reason = row.getColumn(9).getString();
  found.result.steps = static_cast<std::uint64_t>(row.getColumn(10).getInt64());
  found.result.seconds = row.getColumn(11).getDouble();
  return found;
}

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
    while (query.executeStep()) all.push_back(read_row(query));
    return all;
  });
}

void RunArchive::add_reevaluations(std::span<const Reevaluation> reevaluations) {
  database_->guarded(writing, [&] {
    SQLite::Transaction transaction(database_->connection);
    SQLite::Statement protocol(database_->connection, "INSERT OR IGNORE INTO protocol VALUES (?, ?)");
    SQLite::Statement row(database_->connection,
                          "INSERT OR REPLACE INTO reevaluation VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    for (const Reevaluation& reevaluation : reevaluations) {
      const std::string hash = io::content_hash(reevaluation.protocol);
      protocol.reset();
      protocol.bind(1, hash);
      protocol.bind(2, reevaluation.protocol);
      protocol.exec();
      insert(row, reevaluation, hash);
    }
    transaction.commit();
  });
}

}  // namespace menger::evolution
