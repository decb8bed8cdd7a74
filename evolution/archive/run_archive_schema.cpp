#include "evolution/archive/run_archive_schema.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::evolution {

namespace {

namespace fs = std::filesystem;

/// Marks SQLite files as archives of menger: "mngr".
constexpr int application_id = 0x6d6e6772;

constexpr const char* study_table = R"sql(
CREATE TABLE study (
  row INTEGER PRIMARY KEY CHECK (row = 1),
  hash TEXT NOT NULL,
  resolved TEXT NOT NULL,
  generations INTEGER NOT NULL
);
)sql";

/// The columns of the tables of evaluations: those with the time step of the search, and those with half of it.
constexpr const char* evaluation_columns = R"sql((
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

constexpr const char* search_tables = R"sql(
CREATE TABLE individual (
  id INTEGER PRIMARY KEY,
  generation INTEGER NOT NULL,
  parent INTEGER,
  age INTEGER NOT NULL,
  genome TEXT NOT NULL,
  phenotype TEXT NOT NULL
);
CREATE TABLE contender (
  generation INTEGER NOT NULL,
  id INTEGER NOT NULL,
  age INTEGER NOT NULL,
  knowledge TEXT NOT NULL,
  fitness REAL,
  fitness_bound REAL,
  survivor_rank INTEGER,
  PRIMARY KEY (generation, id)
) WITHOUT ROWID;
CREATE TABLE generation (
  number INTEGER PRIMARY KEY,
  evaluations INTEGER NOT NULL,
  cached INTEGER NOT NULL,
  pruned INTEGER NOT NULL,
  seconds REAL NOT NULL,
  variation_generator TEXT NOT NULL,
  selection_generator TEXT NOT NULL
);
)sql";

/// The tables that version 3 has and version 2 has not.
constexpr const char* reevaluation_schema = R"sql(
CREATE TABLE protocol (
  hash TEXT PRIMARY KEY,
  text TEXT NOT NULL
) WITHOUT ROWID;
CREATE TABLE reevaluation (
  design_hash TEXT NOT NULL,
  level INTEGER NOT NULL,
  protocol_hash TEXT NOT NULL,
  variant TEXT NOT NULL,
  duration_s REAL NOT NULL,
  status TEXT,
  dx_m REAL, dy_m REAL, dz_m REAL,
  reason TEXT NOT NULL,
  steps INTEGER NOT NULL,
  seconds REAL NOT NULL,
  PRIMARY KEY (design_hash, level, protocol_hash)
) WITHOUT ROWID;
)sql";
constexpr int version_without_reevaluations = 2;
constexpr int first_version_with_reevaluations = 3;
constexpr int last_version_of_other_keys = 5;
constexpr int first_version_with_present_keys = 7;

int version_of(const SQLite::Database& connection) {
  SQLite::Statement row(connection, "PRAGMA user_version");
  row.executeStep();
  return row.getColumn(0).getInt();
}

/// Returns the columns of a table that hold real numbers.
std::vector<std::string> real_columns(const SQLite::Database& connection, const std::string& table) {
  std::vector<std::string> names;
  SQLite::Statement column(connection, "SELECT name FROM pragma_table_info(?) WHERE type = 'REAL'");
  column.bind(1, table);
  while (column.executeStep()) names.push_back(column.getColumn(0).getString());
  return names;
}

/// Refuses an archive with an infinite number anywhere. SQLite keeps one that is not a number as NULL.
void require_finite_numbers(const fs::path& file, const SQLite::Database& connection) {
  SQLite::Statement table(connection, "SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name");
  while (table.executeStep()) {
    const std::string name = table.getColumn(0).getString();
    for (const std::string& column : real_columns(connection, name)) {
      std::string query("SELECT ");
      query.append(column).append(" > 0 FROM ").append(name).append(" WHERE abs(").append(column).append(") >= 9e999 LIMIT 1");
      SQLite::Statement infinite(connection, query);
      if (!infinite.executeStep()) continue;
      const bool is_positive = infinite.getColumn(0).getInt() != 0;
      std::string reason("is damaged: ");
      reason.append(name).append(".").append(column).append(is_positive ? " = inf" : " = -inf");
      refuse_archive(file, reason.append(": must be a finite number"));
    }
  }
}

/// Refuses a database with objects that no archive has: they could hide or change what menger reads.
void require_own_objects(const fs::path& file, SQLite::Database& connection) {
  constexpr std::array known{
      "study",     "evaluation",          "individual",    "contender", "generation", "protocol",  "reevaluation", "left_out",
      "screening", "period_displacement", "element_count", "scenario",  "step_check", "judgement", "under_way",    "event"};
  SQLite::Statement object(connection, "SELECT type, name, COALESCE(sql, '') FROM sqlite_schema");
  while (object.executeStep()) {
    const std::string type = object.getColumn(0).getString();
    const std::string name = object.getColumn(1).getString();
    const std::string sql = object.getColumn(2).getString();
    if (name.starts_with("sqlite_")) continue;  // SQLite's own: nobody else can give such names
    const bool is_virtual = sql.starts_with("CREATE VIRTUAL");
    if (type == "table" && !is_virtual && std::ranges::find(known, name) != known.end()) continue;
    std::string reason(is_virtual ? "has a virtual " : "has a ");
    reason.append(type).append(" \"").append(name).append("\", which no archive of menger has");
    refuse_archive(file, reason);
  }
}

/// Refuses an archive whose rows contradict each other. SQLite's own check does not find these faults.
void require_consistent_rows(const fs::path& file, SQLite::Database& connection) {
  const auto none = [&](const char* wrong_rows, const char* what) {
    if (connection.execAndGet(std::string("SELECT COUNT(*) FROM ") + wrong_rows).getInt() > 0)
      refuse_archive(file, std::string("is damaged: ") + what);
  };
  require_finite_numbers(file, connection);
  none("evaluation WHERE (status = 'completed') != (dx_m IS NOT NULL AND dy_m IS NOT NULL AND dz_m IS NOT NULL)",
       "an evaluation has a displacement without being completed, or none although it is");
  none("individual WHERE parent >= id", "an individual is older than its parent");
  none(
      "(SELECT COUNT(survivor_rank) AS held, MAX(survivor_rank) + 1 AS ranks, COUNT(DISTINCT survivor_rank) AS different FROM "
      "contender "
      "GROUP BY generation) WHERE held != ranks OR held != different",
      "the survivors of a generation have gaps");
  if (version_of(connection) == version_without_reevaluations) return;
  none("reevaluation WHERE (COALESCE(status, '') = 'completed') != (dx_m IS NOT NULL AND dy_m IS NOT NULL AND dz_m IS NOT NULL)",
       "a re-evaluation has a displacement without being completed, or none although it is");
  none("reevaluation WHERE protocol_hash NOT IN (SELECT hash FROM protocol)", "a re-evaluation has no protocol");
}

}  // namespace

void refuse_archive(const fs::path& file, const std::string& reason) { throw io::InputError(file.string() + ": " + reason); }

void require_database_header(const fs::path& file) {
  constexpr std::string_view header("SQLite format 3\0", 16);
  if (io::read_start(file, header.size()) != header) refuse_archive(file, "is not an archive of menger: not an SQLite database");
}

bool is_empty_database(SQLite::Database& connection) {
  return connection.execAndGet("PRAGMA application_id").getInt() == 0 &&
         connection.execAndGet("SELECT COUNT(*) FROM sqlite_schema").getInt() == 0;
}

void create_schema(SQLite::Database& connection, std::string_view study, int generations) {
  SQLite::Transaction transaction(connection);
  connection.exec(study_table);
  connection.exec(std::string("CREATE TABLE evaluation ") + evaluation_columns);
  connection.exec(search_tables);
  connection.exec(reevaluation_schema);
  connection.exec("PRAGMA application_id = " + std::to_string(application_id));
  connection.exec("PRAGMA user_version = " + std::to_string(RunArchive::schema_version));
  SQLite::Statement insert(connection, "INSERT INTO study VALUES (1, ?, ?, ?)");
  insert.bind(1, io::content_hash(study));
  insert.bind(2, std::string(study));
  insert.bind(3, generations);
  insert.exec();
  transaction.commit();
}

void add_left_out_table(SQLite::Database& connection) {
  connection.exec(R"sql(
CREATE TABLE IF NOT EXISTS left_out (
  design_hash TEXT NOT NULL,
  level INTEGER NOT NULL,
  decided_by_hash TEXT NOT NULL,
  dx_m REAL NOT NULL, dy_m REAL NOT NULL, dz_m REAL NOT NULL,
  PRIMARY KEY (design_hash, level, decided_by_hash)
) WITHOUT ROWID;
)sql");
}

void add_walk_tables(SQLite::Database& connection) {
  connection.exec(R"sql(
CREATE TABLE IF NOT EXISTS period_displacement (
  design_hash TEXT NOT NULL,
  level INTEGER NOT NULL,
  decided_by_hash TEXT NOT NULL,
  period INTEGER NOT NULL,
  dx_m REAL NOT NULL, dy_m REAL NOT NULL, dz_m REAL NOT NULL,
  PRIMARY KEY (design_hash, level, decided_by_hash, period)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS element_count (
  design_hash TEXT NOT NULL,
  level INTEGER NOT NULL,
  decided_by_hash TEXT NOT NULL,
  fidelity TEXT NOT NULL,
  elements INTEGER NOT NULL,
  PRIMARY KEY (design_hash, level, decided_by_hash)
) WITHOUT ROWID;
)sql");
}

void add_screening_table(SQLite::Database& connection) {
  connection.exec(R"sql(
CREATE TABLE IF NOT EXISTS screening (
  id INTEGER PRIMARY KEY,
  generation INTEGER NOT NULL,
  surrogate REAL,
  outcome TEXT NOT NULL,
  probability REAL NOT NULL
);
)sql");
}

void add_scenario_table(SQLite::Database& connection) {
  connection.exec(R"sql(
CREATE TABLE IF NOT EXISTS scenario (
  number INTEGER PRIMARY KEY,
  physics_hash TEXT NOT NULL,
  text TEXT NOT NULL
);
)sql");
}

void add_event_table(SQLite::Database& connection) {
  connection.exec(R"sql(
CREATE TABLE IF NOT EXISTS event (
  number INTEGER PRIMARY KEY,
  individual INTEGER NOT NULL,
  what TEXT NOT NULL
);
)sql");
}

void add_step_check_table(SQLite::Database& connection) {
  connection.exec(std::string("CREATE TABLE IF NOT EXISTS step_check ") + evaluation_columns);
}

void upgrade(SQLite::Database& connection) {
  if (version_of(connection) != version_without_reevaluations) return;
  SQLite::Transaction transaction(connection);
  connection.exec(reevaluation_schema);
  connection.exec("PRAGMA user_version = " + std::to_string(first_version_with_reevaluations));
  transaction.commit();
}

bool has_earlier_keys(const SQLite::Database& connection) { return version_of(connection) <= last_version_of_other_keys; }

void require_present_keys(const fs::path& file, SQLite::Database& connection) {
  const int version = version_of(connection);
  if (version == RunArchive::schema_version) return;
  const std::string study = connection.execAndGet("SELECT resolved FROM study").getString();
  const bool was_corrected = study.find("\n[reference]\n") != std::string::npos;
  refuse_archive(file,
                 "is an archive of schema version " + std::to_string(version) + ", " +
                     (was_corrected ? "of a search that a table [reference] corrected, which finite elements do not do any more"
                      : version < first_version_with_present_keys ? "with earlier keys of studies"
                                                                  : "in which bodies that fell have no displacements") +
                     ": menger export and menger reevaluate can read it, but no search can be resumed from it; choose "
                     "another archive");
}

void require_archive(const fs::path& file, SQLite::Database& connection) {
  if (connection.execAndGet("PRAGMA application_id").getInt() != application_id) {
    refuse_archive(file, "is not an archive of menger: an SQLite database of something else");
  }
  require_own_objects(file, connection);
  const int version = version_of(connection);
  if (version < version_without_reevaluations || version > RunArchive::schema_version) {
    refuse_archive(file, "is an archive of schema version " + std::to_string(version) + ", this menger has version " +
                             std::to_string(RunArchive::schema_version));
  }
  const std::string check = connection.execAndGet("PRAGMA quick_check(1)").getString();
  if (check != "ok") refuse_archive(file, "is damaged: " + check);
  if (connection.execAndGet("SELECT COUNT(*) FROM study").getInt() != 1)
    refuse_archive(file, "is damaged: it does not have exactly one study");
  if (io::content_hash(connection.execAndGet("SELECT resolved FROM study").getString()) !=
      connection.execAndGet("SELECT hash FROM study").getString()) {
    refuse_archive(file, "is damaged: its study was changed");
  }
  require_consistent_rows(file, connection);
}

}  // namespace menger::evolution
