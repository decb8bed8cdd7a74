#include "evolution/archive/run_archive.h"
#include "evolution/archive/run_archive_database.h"

namespace menger::evolution {

namespace {

constexpr std::string_view writing = "cannot be written";

void bind_optional(SQLite::Statement& statement, int index, const std::optional<double>& value) {
  value ? statement.bind(index, *value) : statement.bind(index);
}

template <class Unsigned>
void bind_optional(SQLite::Statement& statement, int index, const std::optional<Unsigned>& value) {
  value ? statement.bind(index, signed_number(*value)) : statement.bind(index);
}

void insert_individual(SQLite::Statement& insert, const Individual& individual) {
  insert.reset();
  insert.bind(1, signed_number(individual.id));
  insert.bind(2, individual.generation);
  bind_optional(insert, 3, individual.parent);
  insert.bind(4, individual.age);
  insert.bind(5, to_text(individual.genome));
  insert.bind(6, phenotype_key(individual.phenotype));
  insert.exec();
}

void insert_contender(SQLite::Statement& insert, int generation, const Contender& contender) {
  insert.reset();
  insert.bind(1, generation);
  insert.bind(2, signed_number(contender.id));
  insert.bind(3, contender.age);
  insert.bind(4, std::string(to_string(contender.knowledge)));
  bind_optional(insert, 5, contender.fitness);
  bind_optional(insert, 6, contender.fitness_bound);
  bind_optional(insert, 7, contender.survivor_rank);
  insert.exec();
}

void insert_generation(SQLite::Statement insert, const GenerationRecord& record) {
  insert.bind(1, record.number);
  insert.bind(2, signed_number(record.evaluations));
  insert.bind(3, signed_number(record.cached));
  insert.bind(4, signed_number(record.pruned));
  insert.bind(5, record.seconds);
  insert.bind(6, record.variation_generator);
  insert.bind(7, record.selection_generator);
  insert.exec();
}

}  // namespace

void insert_evaluation(SQLite::Database& connection, const std::string& table, const EvaluationKey& key,
                       const ArchivedEvaluation& evaluation) {
  const Evaluation& result = evaluation.result;
  SQLite::Statement insert(connection, "INSERT INTO " + table + " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(1, key.design_hash);
  insert.bind(2, key.level);
  insert.bind(3, key.physics_hash);
  insert.bind(4, evaluation.generation);
  insert.bind(5, std::string(io::to_string(result.status)));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto part = result.displacement_m ? std::optional((*result.displacement_m)[axis]) : std::nullopt;
    bind_optional(insert, 6 + static_cast<int>(axis), part);
  }
  insert.bind(9, result.reason);
  insert.bind(10, result.outside_validity);
  insert.bind(11, signed_number(result.steps));
  insert.bind(12, result.seconds);
  insert.exec();
}

void RunArchive::add_evaluation(const EvaluationKey& key, const ArchivedEvaluation& evaluation) {
  database_->guarded(writing, [&] {
    SQLite::Transaction transaction(database_->connection);
    insert_evaluation(database_->connection, "evaluation", key, evaluation);
    if (evaluation.result.left_out_m) insert_left_out(database_->connection, key, *evaluation.result.left_out_m);
    transaction.commit();
  });
}

void RunArchive::add_generation(const GenerationRecord& record, std::span<const Individual> born,
                                std::span<const Contender> contenders) {
  database_->guarded(writing, [&] {
    SQLite::Transaction transaction(database_->connection);
    SQLite::Statement individuals(database_->connection, "INSERT INTO individual VALUES (?, ?, ?, ?, ?, ?)");
    for (const Individual& individual : born) insert_individual(individuals, individual);
    SQLite::Statement entries(database_->connection, "INSERT INTO contender VALUES (?, ?, ?, ?, ?, ?, ?)");
    for (const Contender& contender : contenders) insert_contender(entries, record.number, contender);
    insert_generation(SQLite::Statement(database_->connection, "INSERT INTO generation VALUES (?, ?, ?, ?, ?, ?, ?)"), record);
    transaction.commit();
  });
}

}  // namespace menger::evolution
