#include "evolution/archive/run_archive.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <array>
#include <new>
#include <sstream>
#include <utility>

#include "evolution/archive/archive_log.h"
#include "evolution/archive/run_archive_schema.h"
#include "io/process/file_lock.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/run_status_words.h"
#include "io/text/whole_file.h"

namespace menger::evolution {

namespace {

namespace fs = std::filesystem;

constexpr std::array known_words{Knowledge::evaluated, Knowledge::failed,    Knowledge::bounded,
                                 Knowledge::duplicate, Knowledge::penalised, Knowledge::screened};
constexpr std::array screening_words{Screened::passed, Screened::drawn, Screened::left_out};

Knowledge knowledge_of(const std::string& word) {
  const auto found = std::ranges::find_if(known_words, [&](Knowledge knowledge) { return to_string(knowledge) == word; });
  if (found == known_words.end()) throw io::InputError("\"" + word + "\" is not a word of an archive");
  return *found;
}

Screened screened_of(const std::string& word) {
  const auto found = std::ranges::find_if(screening_words, [&](Screened outcome) { return to_string(outcome) == word; });
  if (found == screening_words.end()) throw io::InputError("\"" + word + "\" is not a word of an archive");
  return *found;
}

constexpr const char* birth_word = "born";
constexpr const char* end_word = "ended";

// SQLite has signed integers only.
std::int64_t signed_number(std::uint64_t number) { return static_cast<std::int64_t>(number); }
std::uint64_t count_in(const SQLite::Column& column) { return static_cast<std::uint64_t>(column.getInt64()); }

void bind_optional(SQLite::Statement& row, const char* name, const std::optional<double>& value) {
  value ? row.bind(name, *value) : row.bind(name);
}

void bind_optional(SQLite::Statement& row, const char* name, const std::optional<std::uint64_t>& value) {
  value ? row.bind(name, signed_number(*value)) : row.bind(name);
}

std::optional<double> optional_double(const SQLite::Column& column) {
  return column.isNull() ? std::nullopt : std::optional(column.getDouble());
}

std::optional<std::uint64_t> optional_count(const SQLite::Column& column) {
  return column.isNull() ? std::nullopt : std::optional(count_in(column));
}

constexpr std::array vector_columns{"dx_m", "dy_m", "dz_m"};
constexpr std::array vector_parameters{":dx_m", ":dy_m", ":dz_m"};

std::optional<std::array<double, 3>> vector_in(const SQLite::Statement& row) {
  std::array<double, 3> vector{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SQLite::Column part = row.getColumn(vector_columns.at(axis));
    if (part.isNull()) return std::nullopt;
    vector.at(axis) = part.getDouble();
  }
  return vector;
}

void bind_vector(SQLite::Statement& row, const std::optional<std::array<double, 3>>& vector) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    bind_optional(row, vector_parameters.at(axis), vector ? std::optional(vector->at(axis)) : std::nullopt);
}

/// Binds the key of a result. The column of its last hash has a different name in every table.
void bind_key(SQLite::Statement& row, const EvaluationKey& key) {
  row.bind(":design_hash", key.design_hash);
  row.bind(":level", key.level);
  row.bind(":decided_by_hash", key.physics_hash);
}

/// Reads the columns that evaluations and re-evaluations share: status, displacement, reason, steps and seconds. The status is
/// NULL if the evaluator itself failed.
Evaluation read_result(const SQLite::Statement& row) {
  Evaluation result;
  if (const SQLite::Column status = row.getColumn("status"); !status.isNull())
    result.status = io::run_status_of(status.getString());
  result.displacement_m = vector_in(row);
  result.reason = row.getColumn("reason").getString();
  result.steps = count_in(row.getColumn("steps"));
  result.seconds = row.getColumn("seconds").getDouble();
  return result;
}

void bind_result(SQLite::Statement& row, const Evaluation& result, bool has_status) {
  has_status ? row.bind(":status", std::string(io::to_string(result.status))) : row.bind(":status");
  bind_vector(row, result.displacement_m);
  row.bind(":reason", result.reason);
  row.bind(":steps", signed_number(result.steps));
  row.bind(":seconds", result.seconds);
}

/// Adds the displacement before the part of an evaluation that counts, if there is one. Its key is that of the result: design,
/// level, and the hash of everything that decides the result besides the body.
void insert_left_out(SQLite::Database& connection, const EvaluationKey& key, const Evaluation& result) {
  if (!result.left_out_m) return;
  add_left_out_table(connection);
  SQLite::Statement row(connection,
                        "INSERT OR REPLACE INTO left_out VALUES (:design_hash, :level, :decided_by_hash, :dx_m, :dy_m, :dz_m)");
  bind_key(row, key);
  bind_vector(row, result.left_out_m);
  row.exec();
}

std::optional<std::array<double, 3>> find_left_out_m(const SQLite::Database& connection, const EvaluationKey& key) {
  if (!connection.tableExists("left_out")) return std::nullopt;
  SQLite::Statement row(connection,
                        "SELECT dx_m, dy_m, dz_m FROM left_out "
                        "WHERE design_hash = :design_hash AND level = :level AND decided_by_hash = :decided_by_hash");
  bind_key(row, key);
  return row.executeStep() ? vector_in(row) : std::nullopt;
}

/// Adds the displacements in every period and the elements of an evaluation, if it has any.
void insert_walk(SQLite::Database& connection, const EvaluationKey& key, const Evaluation& result) {
  if (result.period_displacements_m.empty() && result.fidelity.empty() && result.elements == 0) return;
  add_walk_tables(connection);
  SQLite::Statement period(
      connection,
      "INSERT INTO period_displacement VALUES (:design_hash, :level, :decided_by_hash, :period, :dx_m, :dy_m, :dz_m)");
  for (std::size_t n = 0; n < result.period_displacements_m.size(); ++n) {
    period.reset();
    bind_key(period, key);
    period.bind(":period", static_cast<std::int64_t>(n));
    bind_vector(period, result.period_displacements_m[n]);
    period.exec();
  }
  if (result.fidelity.empty() && result.elements == 0) return;
  SQLite::Statement elements(connection,
                             "INSERT INTO element_count VALUES (:design_hash, :level, :decided_by_hash, :fidelity, :elements)");
  bind_key(elements, key);
  elements.bind(":fidelity", result.fidelity);
  elements.bind(":elements", signed_number(result.elements));
  elements.exec();
}

/// Reads what insert_walk added.
void read_walk(const SQLite::Database& connection, const EvaluationKey& key, Evaluation& result) {
  if (!connection.tableExists("period_displacement")) return;
  const std::string with_key = " WHERE design_hash = :design_hash AND level = :level AND decided_by_hash = :decided_by_hash";
  SQLite::Statement period(connection, "SELECT dx_m, dy_m, dz_m FROM period_displacement" + with_key + " ORDER BY period");
  bind_key(period, key);
  while (period.executeStep()) {
    if (const auto displacement_m = vector_in(period)) result.period_displacements_m.push_back(*displacement_m);
  }
  SQLite::Statement elements(connection, "SELECT fidelity, elements FROM element_count" + with_key);
  bind_key(elements, key);
  if (!elements.executeStep()) return;
  result.fidelity = elements.getColumn("fidelity").getString();
  result.elements = count_in(elements.getColumn("elements"));
}

/// Finds an evaluation in a table with the columns of `evaluation`. Sets only what has a column there.
std::optional<ArchivedEvaluation> find_evaluation(const SQLite::Database& connection, const std::string& table,
                                                  const EvaluationKey& key) {
  SQLite::Statement row(connection,
                        "SELECT generation, status, dx_m, dy_m, dz_m, reason, outside_validity, steps, seconds FROM " + table +
                            " WHERE design_hash = :design_hash AND level = :level AND physics_hash = :decided_by_hash");
  bind_key(row, key);
  if (!row.executeStep()) return std::nullopt;
  ArchivedEvaluation found{.generation = row.getColumn("generation").getInt(), .result = read_result(row)};
  if (found.result.status == io::RunStatus::stopped) throw io::InputError("\"stopped\" is not a word of an archive");
  found.result.outside_validity = row.getColumn("outside_validity").getString();
  return found;
}

void insert_evaluation(SQLite::Database& connection, const std::string& table, const EvaluationKey& key,
                       const ArchivedEvaluation& evaluation) {
  SQLite::Statement row(connection, "INSERT INTO " + table +
                                        " VALUES (:design_hash, :level, :decided_by_hash, :generation, :status, :dx_m, :dy_m, "
                                        ":dz_m, :reason, :outside_validity, :steps, :seconds)");
  bind_key(row, key);
  row.bind(":generation", evaluation.generation);
  bind_result(row, evaluation.result, true);
  row.bind(":outside_validity", evaluation.result.outside_validity);
  row.exec();
}

/// The columns that queries for re-evaluations select besides their own.
constexpr const char* reevaluation_columns =
    "design_hash, level, protocol.text AS protocol, variant, duration_s, status, dx_m, dy_m, dz_m, reason, steps, seconds";

Reevaluation read_reevaluation(const SQLite::Database& connection, const SQLite::Statement& row) {
  Reevaluation found;
  found.design_hash = row.getColumn("design_hash").getString();
  found.level = row.getColumn("level").getInt();
  found.protocol = row.getColumn("protocol").getString();
  found.variant = row.getColumn("variant").getString();
  found.duration_s = row.getColumn("duration_s").getDouble();
  found.has_result = !row.getColumn("status").isNull();
  found.result = read_result(row);
  found.result.left_out_m = find_left_out_m(connection, {found.design_hash, found.level, io::content_hash(found.protocol)});
  return found;
}

void insert_reevaluation(SQLite::Database& connection, const Reevaluation& reevaluation) {
  const EvaluationKey key{reevaluation.design_hash, reevaluation.level, io::content_hash(reevaluation.protocol)};
  SQLite::Statement protocol(connection, "INSERT OR IGNORE INTO protocol VALUES (:hash, :text)");
  protocol.bind(":hash", key.physics_hash);
  protocol.bind(":text", reevaluation.protocol);
  protocol.exec();
  // A run that a budget or a failure ended says nothing about the robot, so it does not replace the result of another call.
  SQLite::Statement row(
      connection,
      "INSERT INTO reevaluation VALUES (:design_hash, :level, :decided_by_hash, :variant, :duration_s, :status, "
      ":dx_m, :dy_m, :dz_m, :reason, :steps, :seconds) "
      "ON CONFLICT (design_hash, level, protocol_hash) DO UPDATE SET variant = excluded.variant, "
      "duration_s = excluded.duration_s, status = excluded.status, dx_m = excluded.dx_m, dy_m = excluded.dy_m, "
      "dz_m = excluded.dz_m, reason = excluded.reason, steps = excluded.steps, seconds = excluded.seconds "
      "WHERE COALESCE(excluded.status, 'stopped') != 'stopped' OR COALESCE(status, 'stopped') = 'stopped'");
  bind_key(row, key);
  row.bind(":variant", reevaluation.variant);
  row.bind(":duration_s", reevaluation.duration_s);
  bind_result(row, reevaluation.result, reevaluation.has_result);
  row.exec();
  insert_left_out(connection, key, reevaluation.result);
}

/// Adds a result to all tables that have a part of it.
void insert_whole_evaluation(SQLite::Database& connection, const EvaluationKey& key, const ArchivedEvaluation& evaluation) {
  insert_evaluation(connection, "evaluation", key, evaluation);
  insert_left_out(connection, key, evaluation.result);
  insert_walk(connection, key, evaluation.result);
}

void insert_screened(SQLite::Database& connection, std::span<const ScreenedIndividual> screened) {
  add_screening_table(connection);
  SQLite::Statement row(connection, "INSERT INTO screening VALUES (:id, :generation, :surrogate, :outcome, :probability)");
  for (const ScreenedIndividual& one : screened) {
    row.reset();
    row.bind(":id", signed_number(one.id));
    row.bind(":generation", one.generation);
    bind_optional(row, ":surrogate", one.surrogate);
    row.bind(":outcome", std::string(to_string(one.outcome)));
    row.bind(":probability", one.probability);
    row.exec();
  }
}

PoolMember read_pool_member(const SQLite::Statement& row) {
  return {.id = count_in(row.getColumn("id")),
          .age = row.getColumn("age").getInt(),
          .fitness = optional_double(row.getColumn("fitness")),
          .knowledge = knowledge_of(row.getColumn("knowledge").getString()),
          .fitness_bound = optional_double(row.getColumn("fitness_bound")),
          .survivor_rank = optional_count(row.getColumn("survivor_rank"))};
}

void insert_pool_member(SQLite::Statement& row, int generation, const PoolMember& member) {
  row.reset();
  row.bind(":generation", generation);
  row.bind(":id", signed_number(member.id));
  row.bind(":age", member.age);
  row.bind(":knowledge", std::string(to_string(member.knowledge)));
  bind_optional(row, ":fitness", member.fitness);
  bind_optional(row, ":fitness_bound", member.fitness_bound);
  bind_optional(row, ":survivor_rank", member.survivor_rank);
  row.exec();
}

Individual read_individual(const SQLite::Statement& row) {
  return {.id = count_in(row.getColumn("id")),
          .generation = row.getColumn("generation").getInt(),
          .parent = optional_count(row.getColumn("parent")),
          .age = row.getColumn("age").getInt(),
          .genome = genome_from_text(row.getColumn("genome").getString()),
          .phenotype = phenotype_from_key(row.getColumn("phenotype").getString())};
}

void insert_individual(SQLite::Statement& row, const Individual& individual) {
  row.reset();
  row.bind(":id", signed_number(individual.id));
  row.bind(":generation", individual.generation);
  bind_optional(row, ":parent", individual.parent);
  row.bind(":age", individual.age);
  row.bind(":genome", to_text(individual.genome));
  row.bind(":phenotype", phenotype_key(individual.phenotype));
  row.exec();
}

GenerationRecord read_generation(const SQLite::Statement& row) {
  return {.number = row.getColumn("number").getInt(),
          .evaluations = count_in(row.getColumn("evaluations")),
          .cached = count_in(row.getColumn("cached")),
          .pruned = count_in(row.getColumn("pruned")),
          .seconds = row.getColumn("seconds").getDouble(),
          .variation_generator = row.getColumn("variation_generator").getString(),
          .selection_generator = row.getColumn("selection_generator").getString()};
}

void insert_generation(SQLite::Database& connection, const GenerationRecord& record) {
  SQLite::Statement row(connection,
                        "INSERT INTO generation VALUES (:number, :evaluations, :cached, :pruned, :seconds, :variation_generator, "
                        ":selection_generator)");
  row.bind(":number", record.number);
  row.bind(":evaluations", signed_number(record.evaluations));
  row.bind(":cached", signed_number(record.cached));
  row.bind(":pruned", signed_number(record.pruned));
  row.bind(":seconds", record.seconds);
  row.bind(":variation_generator", record.variation_generator);
  row.bind(":selection_generator", record.selection_generator);
  row.exec();
}

void require_same_study(const fs::path& file, std::string_view archived, std::string_view given) {
  if (archived == given) return;
  std::istringstream old_lines{std::string(archived)};
  std::istringstream new_lines{std::string(given)};
  std::string old_line;
  std::string new_line;
  std::string table;
  do {
    old_line.clear();
    new_line.clear();
    std::getline(old_lines, old_line);
    std::getline(new_lines, new_line);
    if (old_line.starts_with('[') && old_line == new_line) table = old_line + " ";
  } while (old_line == new_line && old_lines && new_lines);
  refuse_archive(file, "is the archive of another study: it has " + table + old_line + ", this study has " + table + new_line +
                           "; choose another archive");
}

}  // namespace

std::string_view to_string(Screened outcome) {
  switch (outcome) {
    case Screened::passed:
      return "passed";
    case Screened::drawn:
      return "drawn";
    case Screened::left_out:
      break;
  }
  return "left out";
}

std::string design_hash(const Phenotype& phenotype, int level) {
  Phenotype part = phenotype;
  // An empty arrangement replaces one that does not matter at this level.
  if (level < 3 && part.has_arrangements()) part.arrangement_of_arrangements = meshes::Polycube(3, 3, 3);
  if (level < 2 && part.has_arrangements()) part.arrangement = meshes::Polycube(3, 3, 3);
  return phenotype_hash(part);
}

/// The open database of an archive. The lock is released after the database is closed.
class RunArchive::Database {
 public:
  Database(fs::path archive, std::optional<io::FileLock> held, SQLite::Database&& opened)
      : file_(std::move(archive)),
        lock_(std::move(held)),
        connection_(std::move(opened)),
        has_earlier_keys_(has_earlier_keys(connection_)) {}
  ~Database() {
    if (lock_) end_log(connection_);
  }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  [[nodiscard]] const fs::path& file() const { return file_; }

  /// Returns the key with which a table has a result; see RunArchive::evaluation.
  [[nodiscard]] EvaluationKey key_in(const std::string& table, EvaluationKey key) const {
    if (!has_earlier_keys_) return key;
    SQLite::Statement row(connection_, "SELECT DISTINCT physics_hash FROM " + table + " LIMIT 2");
    if (row.executeStep()) key.physics_hash = row.getColumn(0).getString();
    if (row.executeStep()) refuse_archive(file_, "is damaged: its results in " + table + " are of more than one physics");
    return key;
  }

  template <class Work>
  auto read(const Work& work) {
    return guarded("cannot be read", [&] { return work(connection_); });
  }

  /// Adds everything that `work` adds, or nothing.
  template <class Work>
  void write(const Work& work) {
    guarded("cannot be written", [&] {
      SQLite::Transaction transaction(connection_);
      work(connection_);
      transaction.commit();
    });
  }

  /// Moves the changes in the log into the file, so that a copy of the file alone is complete. If there are readers, this happens
  /// when the last one closes the archive.
  void fold_log() {
    guarded("cannot be written", [&] { connection_.exec("PRAGMA wal_checkpoint(TRUNCATE)"); });
  }

 private:
  /// Turns an error of the database, or of a text in it, into an InputError that names the archive.
  template <class Work>
  auto guarded(const char* doing, const Work& work) -> decltype(work()) {
    try {
      return work();
    } catch (const SQLite::Exception& error) {
      refuse_archive(file_, std::string(doing) + ": " + error.what());
    } catch (const io::InputError& error) {
      const std::string message = error.what();
      if (message.starts_with(file_.string())) throw;
      refuse_archive(file_, "is damaged: " + message);
    } catch (const std::bad_alloc&) {
      refuse_archive(file_, "does not fit into memory");
    }
  }

  fs::path file_;
  std::optional<io::FileLock> lock_;
  SQLite::Database connection_;
  bool has_earlier_keys_;
};

RunArchive::RunArchive(std::unique_ptr<Database> database) : database_(std::move(database)) {}
RunArchive::~RunArchive() = default;
RunArchive::RunArchive(RunArchive&&) noexcept = default;
RunArchive& RunArchive::operator=(RunArchive&&) noexcept = default;

RunArchive RunArchive::open(const fs::path& file, std::string_view study, int generations) {
  // With an empty name SQLite opens a temporary database.
  if (file.empty()) throw io::InputError("the archive needs a file name");
  std::error_code unknown;
  if (fs::is_directory(file, unknown)) refuse_archive(file, "cannot be written: it is a folder");
  io::require_writable_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
  io::FileLock lock(file);
  // A process that died while it made the archive leaves no file, an empty file or an empty database.
  std::error_code missing;
  const bool has_content = fs::exists(file, missing) && fs::file_size(file, missing) > 0;
  if (has_content) require_database_header(file);
  try {
    if (has_content) require_log(file);
    SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, patience_ms);
    distrust(connection);
    if (!is_empty_database(connection)) {
      require_archive(file, connection);
      require_present_keys(file, connection);
      require_same_study(file, connection.execAndGet("SELECT resolved FROM study").getString(), study);
    }
    // Before the log begins, so that the file itself is an archive from the first moment.
    if (is_empty_database(connection)) create_schema(connection, study, generations);
    begin_log(connection);
    // Committed changes survive the death of the process. A power failure may lose the last commits; the search then makes the
    // same again. Flushing every commit would make searches of small bodies a tenth slower.
    connection.exec("PRAGMA synchronous = NORMAL");
    if (connection.execAndGet("SELECT generations FROM study").getInt() != generations) {
      SQLite::Statement update(connection, "UPDATE study SET generations = ?");
      update.bind(1, generations);
      update.exec();
    }
    return RunArchive(std::make_unique<Database>(file, std::move(lock), std::move(connection)));
  } catch (const SQLite::Exception& error) {
    refuse_archive(file, std::string("cannot be used as an archive: ") + error.what());
  }
}

RunArchive RunArchive::open_to_extend(const fs::path& file) {
  std::error_code missing;
  if (!fs::is_regular_file(file, missing)) refuse_archive(file, "there is no such file");
  io::FileLock lock(file);
  require_database_header(file);
  try {
    require_log(file);
    SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READWRITE, patience_ms);
    distrust(connection);
    require_archive(file, connection);
    begin_log(connection);
    upgrade(connection);
    return RunArchive(std::make_unique<Database>(file, std::move(lock), std::move(connection)));
  } catch (const SQLite::Exception& error) {
    refuse_archive(file, std::string("cannot be extended: ") + error.what());
  }
}

RunArchive RunArchive::open_to_read(const fs::path& file) {
  std::error_code missing;
  if (!fs::is_regular_file(file, missing)) refuse_archive(file, "there is no such file");
  require_database_header(file);
  try {
    SQLite::Database connection = open_for_reading(file);
    distrust(connection);
    require_archive(file, connection);
    // One long read transaction sees one state, whatever another process adds meanwhile.
    connection.exec("BEGIN");
    return RunArchive(std::make_unique<Database>(file, std::nullopt, std::move(connection)));
  } catch (const SQLite::Exception& error) {
    refuse_archive(file, std::string("cannot be read as an archive: ") + error.what());
  }
}

const fs::path& RunArchive::file() const { return database_->file(); }

std::string RunArchive::study() const {
  return database_->read(
      [](SQLite::Database& connection) { return connection.execAndGet("SELECT resolved FROM study").getString(); });
}

int RunArchive::generation_goal() const {
  return database_->read(
      [](SQLite::Database& connection) { return connection.execAndGet("SELECT generations FROM study").getInt(); });
}

std::optional<int> RunArchive::last_generation() const {
  return database_->read([](SQLite::Database& connection) -> std::optional<int> {
    const SQLite::Column last = connection.execAndGet("SELECT MAX(number) FROM generation");
    return last.isNull() ? std::nullopt : std::optional(last.getInt());
  });
}

GenerationRecord RunArchive::generation(int number) const {
  return database_->read([&](const SQLite::Database& connection) {
    SQLite::Statement row(connection, "SELECT * FROM generation WHERE number = :number");
    row.bind(":number", number);
    if (!row.executeStep()) refuse_archive(file(), "has no generation " + std::to_string(number));
    return read_generation(row);
  });
}

std::vector<PoolMember> RunArchive::pool(int generation) const {
  return database_->read([&](const SQLite::Database& connection) {
    SQLite::Statement row(connection, "SELECT * FROM contender WHERE generation = :generation ORDER BY id");
    row.bind(":generation", generation);
    std::vector<PoolMember> all;
    while (row.executeStep()) all.push_back(read_pool_member(row));
    return all;
  });
}

std::vector<PoolMember> RunArchive::survivors(int generation) const {
  std::vector<PoolMember> all = pool(generation);
  std::erase_if(all, [](const PoolMember& member) { return !member.survivor_rank; });
  std::ranges::sort(all, {}, &PoolMember::survivor_rank);
  return all;
}

Individual RunArchive::individual(std::uint64_t id) const {
  return database_->read([&](const SQLite::Database& connection) {
    SQLite::Statement row(connection, "SELECT * FROM individual WHERE id = :id");
    row.bind(":id", signed_number(id));
    if (!row.executeStep()) refuse_archive(file(), "has no individual " + std::to_string(id));
    return read_individual(row);
  });
}

std::uint64_t RunArchive::next_id() const {
  return database_->read([](SQLite::Database& connection) {
    return count_in(connection.execAndGet("SELECT COALESCE(MAX(id) + 1, 0) FROM individual"));
  });
}

std::vector<std::string> RunArchive::tried_phenotype_keys() const {
  return database_->read([](const SQLite::Database& connection) {
    std::string tried = "SELECT DISTINCT phenotype FROM individual";
    if (connection.tableExists("screening"))
      tried += " WHERE id NOT IN (SELECT id FROM screening WHERE outcome = '" + std::string(to_string(Screened::left_out)) + "')";
    SQLite::Statement row(connection, tried + " ORDER BY phenotype");
    std::vector<std::string> keys;
    while (row.executeStep()) keys.push_back(row.getColumn("phenotype").getString());
    return keys;
  });
}

std::vector<FitDesign> RunArchive::fit_designs() const {
  return database_->read([](const SQLite::Database& connection) {
    SQLite::Statement row(connection,
                          "SELECT MIN(individual.id) AS first, individual.phenotype AS phenotype, MAX(contender.fitness) AS best "
                          "FROM contender JOIN individual ON individual.id = contender.id WHERE contender.fitness IS NOT NULL "
                          "GROUP BY individual.phenotype ORDER BY best DESC, MIN(individual.id)");
    std::vector<FitDesign> designs;
    while (row.executeStep()) {
      designs.push_back({.individual = count_in(row.getColumn("first")),
                         .phenotype = phenotype_from_key(row.getColumn("phenotype").getString()),
                         .fitness = row.getColumn("best").getDouble()});
    }
    return designs;
  });
}

void RunArchive::add_generation(const GenerationRecord& record, std::span<const Individual> born,
                                std::span<const PoolMember> pool, std::span<const ScreenedIndividual> screened) {
  database_->write([&](SQLite::Database& connection) {
    if (!screened.empty()) insert_screened(connection, screened);
    SQLite::Statement individuals(connection,
                                  "INSERT INTO individual VALUES (:id, :generation, :parent, :age, :genome, :phenotype)");
    for (const Individual& individual : born) insert_individual(individuals, individual);
    SQLite::Statement entries(
        connection,
        "INSERT INTO contender VALUES (:generation, :id, :age, :knowledge, :fitness, :fitness_bound, :survivor_rank)");
    for (const PoolMember& member : pool) insert_pool_member(entries, record.number, member);
    insert_generation(connection, record);
  });
}

std::vector<ScreenedIndividual> RunArchive::screened_individuals(int from_generation) const {
  return database_->read([&](const SQLite::Database& connection) {
    std::vector<ScreenedIndividual> all;
    if (!connection.tableExists("screening")) return all;
    SQLite::Statement row(connection, "SELECT * FROM screening WHERE generation >= :from ORDER BY id");
    row.bind(":from", from_generation);
    while (row.executeStep()) {
      all.push_back({.id = count_in(row.getColumn("id")),
                     .generation = row.getColumn("generation").getInt(),
                     .surrogate = optional_double(row.getColumn("surrogate")),
                     .outcome = screened_of(row.getColumn("outcome").getString()),
                     .probability = row.getColumn("probability").getDouble()});
    }
    return all;
  });
}

std::optional<ArchivedEvaluation> RunArchive::evaluation(const EvaluationKey& asked) const {
  return database_->read([&](const SQLite::Database& connection) {
    const EvaluationKey key = database_->key_in("evaluation", asked);
    std::optional<ArchivedEvaluation> found = find_evaluation(connection, "evaluation", key);
    if (!found) return found;
    found->result.left_out_m = find_left_out_m(connection, key);
    read_walk(connection, key, found->result);
    return found;
  });
}

void RunArchive::add_evaluation(const EvaluationKey& key, const ArchivedEvaluation& evaluation) {
  database_->write([&](SQLite::Database& connection) { insert_whole_evaluation(connection, key, evaluation); });
}

void RunArchive::add_events(std::span<const SearchEvent> events,
                            std::span<const std::pair<EvaluationKey, ArchivedEvaluation>> results) {
  database_->write([&](SQLite::Database& connection) {
    for (const auto& [key, evaluation] : results) insert_whole_evaluation(connection, key, evaluation);
    add_event_table(connection);
    auto number = connection.execAndGet("SELECT COALESCE(MAX(number) + 1, 0) FROM event").getInt64();
    SQLite::Statement row(connection, "INSERT INTO event VALUES (:number, :individual, :what)");
    for (const SearchEvent& event : events) {
      row.reset();
      row.bind(":number", number++);
      row.bind(":individual", signed_number(event.individual));
      row.bind(":what", event.is_birth ? birth_word : end_word);
      row.exec();
    }
  });
}

std::vector<SearchEvent> RunArchive::events() const {
  return database_->read([](const SQLite::Database& connection) {
    std::vector<SearchEvent> all;
    if (!connection.tableExists("event")) return all;
    SQLite::Statement row(connection, "SELECT individual, what FROM event ORDER BY number");
    while (row.executeStep()) {
      const std::string what = row.getColumn("what").getString();
      if (what != birth_word && what != end_word) throw io::InputError("\"" + what + "\" is not a word of an archive");
      all.push_back({.individual = count_in(row.getColumn("individual")), .is_birth = what == birth_word});
    }
    return all;
  });
}

std::uint64_t RunArchive::evaluations_outside_validity(int generation, const std::string& physics_hash) const {
  return database_->read([&](const SQLite::Database& connection) {
    SQLite::Statement row(connection,
                          "SELECT COUNT(*) AS outside FROM evaluation WHERE generation = :generation AND outside_validity != '' "
                          "AND physics_hash = :physics");
    row.bind(":generation", generation);
    row.bind(":physics", database_->key_in("evaluation", {"", 1, physics_hash}).physics_hash);
    row.executeStep();
    return count_in(row.getColumn("outside"));
  });
}

std::vector<Reevaluation> RunArchive::reevaluations() const {
  return database_->read([](const SQLite::Database& connection) {
    std::vector<Reevaluation> all;
    if (!connection.tableExists("reevaluation")) return all;
    SQLite::Statement row(connection, std::string("SELECT ") + reevaluation_columns +
                                          " FROM reevaluation JOIN protocol ON protocol.hash = protocol_hash "
                                          "ORDER BY design_hash, level, protocol_hash");
    while (row.executeStep()) all.push_back(read_reevaluation(connection, row));
    return all;
  });
}

void RunArchive::add_reevaluations(std::span<const Reevaluation> reevaluations) {
  database_->write([&](SQLite::Database& connection) {
    for (const Reevaluation& reevaluation : reevaluations) insert_reevaluation(connection, reevaluation);
  });
  database_->fold_log();
}

void RunArchive::set_scenarios(std::span<const ArchivedScenario> scenarios) {
  database_->write([&](SQLite::Database& connection) {
    add_scenario_table(connection);
    connection.exec("DELETE FROM scenario");
    SQLite::Statement row(connection, "INSERT INTO scenario VALUES (:number, :physics_hash, :text)");
    for (std::size_t n = 0; n < scenarios.size(); ++n) {
      row.reset();
      row.bind(":number", static_cast<std::int64_t>(n));
      row.bind(":physics_hash", scenarios[n].physics_hash);
      row.bind(":text", scenarios[n].text);
      row.exec();
    }
  });
}

std::vector<ArchivedScenario> RunArchive::scenarios() const {
  return database_->read([](const SQLite::Database& connection) {
    std::vector<ArchivedScenario> all;
    if (!connection.tableExists("scenario")) return all;
    SQLite::Statement row(connection, "SELECT physics_hash, text FROM scenario ORDER BY number");
    while (row.executeStep()) all.push_back({row.getColumn("physics_hash").getString(), row.getColumn("text").getString()});
    return all;
  });
}

std::optional<ArchivedEvaluation> RunArchive::step_check(const EvaluationKey& key) const {
  return database_->read([&](const SQLite::Database& connection) -> std::optional<ArchivedEvaluation> {
    if (!connection.tableExists("step_check")) return std::nullopt;
    return find_evaluation(connection, "step_check", database_->key_in("step_check", key));
  });
}

void RunArchive::add_step_check(const EvaluationKey& key, const ArchivedEvaluation& evaluation) {
  database_->write([&](SQLite::Database& connection) {
    add_step_check_table(connection);
    insert_evaluation(connection, "step_check", key, evaluation);
  });
}

}  // namespace menger::evolution
