#include "evolution/archive/run_archive.h"

#include <algorithm>
#include <array>
#include <utility>

#include "evolution/archive/run_archive_database.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"

namespace menger::evolution {

namespace {

constexpr std::array known_words{Knowledge::evaluated, Knowledge::failed, Knowledge::bounded, Knowledge::duplicate,
                                 Knowledge::penalised};

/// The value that a word of the archive stands for.
template <class Value, std::size_t count>
Value from_word(const std::array<Value, count>& values, const std::string& word) {
  const auto found = std::ranges::find_if(values, [&](Value value) { return to_string(value) == word; });
  if (found == values.end()) throw io::InputError("\"" + word + "\" is not a word of an archive");
  return *found;
}

constexpr std::array statuses{io::RunStatus::completed,   io::RunStatus::diverged,         io::RunStatus::not_converged,
                              io::RunStatus::limit_point, io::RunStatus::inverted_element, io::RunStatus::wall_contact};

std::optional<double> optional_double(const SQLite::Column& column) {
  return column.isNull() ? std::nullopt : std::optional(column.getDouble());
}

Contender read_contender(SQLite::Statement& row) {
  Contender contender;
  contender.id = static_cast<std::uint64_t>(row.getColumn(0).getInt64());
  contender.age = row.getColumn(1).getInt();
  contender.knowledge = from_word(known_words, row.getColumn(2).getString());
  contender.fitness = optional_double(row.getColumn(3));
  contender.fitness_bound = optional_double(row.getColumn(4));
  if (!row.getColumn(5).isNull()) contender.survivor_rank = static_cast<std::size_t>(row.getColumn(5).getInt64());
  return contender;
}

constexpr std::string_view reading = "cannot be read";

}  // namespace

std::string design_hash(const Phenotype& phenotype, int level) {
  Phenotype part = phenotype;
  // An empty arrangement stands for one that does not matter yet.
  if (level < 3 && part.has_arrangements()) part.arrangement_of_arrangements = meshes::Polycube(3, 3, 3);
  if (level < 2 && part.has_arrangements()) part.arrangement = meshes::Polycube(3, 3, 3);
  return phenotype_hash(part);
}

std::string_view to_string(Knowledge knowledge) {
  switch (knowledge) {
    case Knowledge::evaluated:
      return "evaluated";
    case Knowledge::failed:
      return "failed";
    case Knowledge::bounded:
      return "bounded";
    case Knowledge::duplicate:
      return "duplicate";
    case Knowledge::penalised:
      return "penalised";
  }
  return {};
}

RunArchive::RunArchive(std::unique_ptr<Database> database) : database_(std::move(database)) {}
RunArchive::~RunArchive() = default;
RunArchive::RunArchive(RunArchive&&) noexcept = default;
RunArchive& RunArchive::operator=(RunArchive&&) noexcept = default;

const std::filesystem::path& RunArchive::file() const { return database_->file; }

std::string RunArchive::study() const {
  return database_->guarded(reading, [&] { return database_->connection.execAndGet("SELECT resolved FROM study").getString(); });
}

int RunArchive::generation_goal() const {
  return database_->guarded(reading, [&] { return database_->connection.execAndGet("SELECT generations FROM study").getInt(); });
}

std::optional<int> RunArchive::last_generation() const {
  return database_->guarded(reading, [&]() -> std::optional<int> {
    SQLite::Statement query(database_->connection, "SELECT MAX(number) FROM generation");
    query.executeStep();
    if (query.getColumn(0).isNull()) return std::nullopt;
    return query.getColumn(0).getInt();
  });
}

GenerationRecord RunArchive::generation(int number) const {
  return database_->guarded(reading, [&] {
    SQLite::Statement query(database_->connection,
                            "SELECT evaluations, cached, pruned, seconds, variation_generator, selection_generator "
                            "FROM generation WHERE number = ?");
    query.bind(1, number);
    if (!query.executeStep()) throw io::InputError(file().string() + ": holds no generation " + std::to_string(number));
    const auto count = [&](int column) { return static_cast<std::uint64_t>(query.getColumn(column).getInt64()); };
    return GenerationRecord{number,
                            count(0),
                            count(1),
                            count(2),
                            query.getColumn(3).getDouble(),
                            query.getColumn(4).getString(),
                            query.getColumn(5).getString()};
  });
}

std::vector<Contender> RunArchive::contenders(int generation) const {
  return database_->guarded(reading, [&] {
    SQLite::Statement query(database_->connection,
                            "SELECT id, age, knowledge, fitness, fitness_bound, survivor_rank FROM contender "
                            "WHERE generation = ? ORDER BY id");
    query.bind(1, generation);
    std::vector<Contender> all;
    while (query.executeStep()) all.push_back(read_contender(query));
    return all;
  });
}

Individual RunArchive::individual(std::uint64_t id) const {
  return database_->guarded(reading, [&] {
    SQLite::Statement query(database_->connection,
                            "SELECT generation, parent, age, genome, phenotype FROM individual WHERE id = ?");
    query.bind(1, signed_number(id));
    if (!query.executeStep()) throw io::InputError(file().string() + ": holds no individual " + std::to_string(id));
    Individual individual;
    individual.id = id;
    individual.generation = query.getColumn(0).getInt();
    individual.age = query.getColumn(2).getInt();
    if (!query.getColumn(1).isNull()) individual.parent = static_cast<std::uint64_t>(query.getColumn(1).getInt64());
    individual.genome = genome_from_text(query.getColumn(3).getString());
    individual.phenotype = phenotype_from_key(query.getColumn(4).getString());
    return individual;
  });
}

std::uint64_t RunArchive::next_id() const {
  return database_->guarded(reading, [&] {
    const auto next = database_->connection.execAndGet("SELECT COALESCE(MAX(id) + 1, 0) FROM individual").getInt64();
    return static_cast<std::uint64_t>(next);
  });
}

std::vector<std::string> RunArchive::phenotype_keys() const {
  return database_->guarded(reading, [&] {
    SQLite::Statement query(database_->connection, "SELECT DISTINCT phenotype FROM individual ORDER BY phenotype");
    std::vector<std::string> keys;
    while (query.executeStep()) keys.push_back(query.getColumn(0).getString());
    return keys;
  });
}

std::uint64_t RunArchive::evaluations_outside_validity(int generation) const {
  return database_->guarded(reading, [&] {
    SQLite::Statement query(database_->connection,
                            "SELECT COUNT(*) FROM evaluation WHERE generation = ? AND outside_validity != ''");
    query.bind(1, generation);
    query.executeStep();
    return static_cast<std::uint64_t>(query.getColumn(0).getInt64());
  });
}

std::optional<ArchivedEvaluation> find_evaluation(const SQLite::Database& connection, const std::string& table,
                                                  const EvaluationKey& key) {
  SQLite::Statement query(connection,
                          "SELECT generation, status, dx_m, dy_m, dz_m, reason, outside_validity, steps, seconds FROM " + table +
                              " WHERE design_hash = ? AND level = ? AND physics_hash = ?");
  query.bind(1, key.design_hash);
  query.bind(2, key.level);
  query.bind(3, key.physics_hash);
  if (!query.executeStep()) return std::nullopt;
  ArchivedEvaluation found;
  found.generation = query.getColumn(0).getInt();
  found.result.status = from_word(statuses, query.getColumn(1).getString());
  if (!query.getColumn(2).isNull()) {
    found.result.displacement_m = {query.getColumn(2).getDouble(), query.getColumn(3).getDouble(),
                                   query.getColumn(4).getDouble()};
  }
  found.result.reason = query.getColumn(5).getString();
  found.result.outside_validity = query.getColumn(6).getString();
  found.result.steps = static_cast<std::uint64_t>(query.getColumn(7).getInt64());
  found.result.seconds = query.getColumn(8).getDouble();
  return found;
}

std::optional<ArchivedEvaluation> RunArchive::evaluation(const EvaluationKey& key) const {
  return database_->guarded(reading, [&] {
    std::optional<ArchivedEvaluation> found = find_evaluation(database_->connection, "evaluation", key);
    if (found) found->result.left_out_m = left_out_m(database_->connection, key);
    return found;
  });
}

}  // namespace menger::evolution
