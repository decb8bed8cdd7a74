#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "evolution/run_archive.h"
#include "evolution/run_archive_database.h"
#include "io/content_hash.h"
#include "io/input_error.h"
#include "io/whole_file.h"

namespace menger::evolution {

namespace {

namespace fs = std::filesystem;

/// Marks SQLite files as archives of menger: "mngr".
constexpr int application_id = 0x6d6e6772;

constexpr const char* schema = R"sql(
CREATE TABLE study (
  row INTEGER PRIMARY KEY CHECK (row = 1),
  hash TEXT NOT NULL,
  resolved TEXT NOT NULL,
  generations INTEGER NOT NULL
);
CREATE TABLE evaluation (
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

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) { throw io::InputError(file.string() + ": " + reason); }

/// Looks at the first bytes before SQLite does, since it would take any short file for an empty database.
void require_database_header(const fs::path& file) {
  constexpr std::string_view header("SQLite format 3\0", 16);
  std::array<char, header.size()> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  if (std::string_view(begin.data(), begin.size()) != header) refuse(file, "is not an archive of menger: not an SQLite database");
}

bool is_empty_database(SQLite::Database& connection) {
  return connection.execAndGet("PRAGMA application_id").getInt() == 0 &&
         connection.execAndGet("SELECT COUNT(*) FROM sqlite_schema").getInt() == 0;
}

void create_schema(SQLite::Database& connection, std::string_view study, int generations) {
  SQLite::Transaction transaction(connection);
  connection.exec(schema);
  connection.exec("PRAGMA application_id = " + std::to_string(application_id));
  connection.exec("PRAGMA user_version = " + std::to_string(RunArchive::schema_version));
  SQLite::Statement insert(connection, "INSERT INTO study VALUES (1, ?, ?, ?)");
  insert.bind(1, io::content_hash(study));
  insert.bind(2, std::string(study));
  insert.bind(3, generations);
  insert.exec();
  transaction.commit();
}

/// What the pages cannot show: rows that contradict each other.
void require_consistent_rows(const fs::path& file, SQLite::Database& connection) {
  const auto none = [&](const char* wrong_rows, const char* what) {
    if (connection.execAndGet(std::string("SELECT COUNT(*) FROM ") + wrong_rows).getInt() > 0)
      refuse(file, std::string("is damaged: ") + what);
  };
  none("evaluation WHERE (status = 'completed') != (dx_m IS NOT NULL AND dy_m IS NOT NULL AND dz_m IS NOT NULL)",
       "an evaluation has a displacement without being completed, or none although it is");
  none("individual WHERE parent >= id", "an individual is older than its parent");
  none(
      "(SELECT COUNT(survivor_rank) AS held, MAX(survivor_rank) + 1 AS ranks, COUNT(DISTINCT survivor_rank) AS different FROM "
      "contender "
      "GROUP BY generation) WHERE held != ranks OR held != different",
      "the survivors of a generation have gaps");
}

void require_archive(const fs::path& file, SQLite::Database& connection) {
  if (connection.execAndGet("PRAGMA application_id").getInt() != application_id) {
    refuse(file, "is not an archive of menger: an SQLite database of something else");
  }
  const int version = connection.execAndGet("PRAGMA user_version").getInt();
  if (version != RunArchive::schema_version) {
    refuse(file, "is an archive of schema version " + std::to_string(version) + ", this menger has version " +
                     std::to_string(RunArchive::schema_version));
  }
  const std::string check = connection.execAndGet("PRAGMA quick_check(1)").getString();
  if (check != "ok") refuse(file, "is damaged: " + check);
  if (connection.execAndGet("SELECT COUNT(*) FROM study").getInt() != 1) refuse(file, "is damaged: it names no study");
  if (io::content_hash(connection.execAndGet("SELECT resolved FROM study").getString()) !=
      connection.execAndGet("SELECT hash FROM study").getString()) {
    refuse(file, "is damaged: its study is not the one it was made for");
  }
  require_consistent_rows(file, connection);
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
  refuse(file, "is the archive of another study: it has " + table + old_line + ", the study has " + table + new_line +
                   "; give this study another archive");
}

}  // namespace

RunArchive RunArchive::open(const fs::path& file, std::string_view study, int generations) {
  // SQLite takes an empty name for a database of its own that vanishes.
  if (file.empty()) throw io::InputError("the archive needs a file name");
  std::error_code unknown;
  if (fs::is_directory(file, unknown)) refuse(file, "cannot be written: it is a folder");
  io::require_writable_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
  ArchiveLock lock(file);
  // A process that died while it made the archive leaves nothing, an empty file or an empty database.
  std::error_code missing;
  if (fs::exists(file, missing) && fs::file_size(file, missing) > 0) require_database_header(file);
  try {
    SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    if (!is_empty_database(connection)) {
      require_archive(file, connection);
      require_same_study(file, connection.execAndGet("SELECT resolved FROM study").getString(), study);
    }
    connection.exec("PRAGMA journal_mode = WAL");
    // What is committed survives the death of the process. A power failure may take the last commits, which are then made again,
    // the same; to flush each of them would slow small bodies down by a tenth.
    connection.exec("PRAGMA synchronous = NORMAL");
    if (is_empty_database(connection)) create_schema(connection, study, generations);
    RunArchive archive(std::make_unique<Database>(file, std::move(lock), std::move(connection)));
    if (archive.generation_goal() != generations) {
      SQLite::Statement update(archive.database_->connection, "UPDATE study SET generations = ?");
      update.bind(1, generations);
      update.exec();
    }
    return archive;
  } catch (const SQLite::Exception& error) {
    refuse(file, std::string("cannot be used as an archive: ") + error.what());
  }
}

RunArchive RunArchive::open_to_read(const fs::path& file) {
  std::error_code missing;
  if (!fs::is_regular_file(file, missing)) refuse(file, "there is no such file");
  require_database_header(file);
  try {
    SQLite::Database connection(fs::absolute(file).string(), SQLite::OPEN_READONLY, 10000);
    require_archive(file, connection);
    // One long read sees one state, whatever another process adds meanwhile.
    connection.exec("BEGIN");
    return RunArchive(std::make_unique<Database>(file, std::nullopt, std::move(connection)));
  } catch (const SQLite::Exception& error) {
    refuse(file, std::string("cannot be read as an archive: ") + error.what());
  }
}

}  // namespace menger::evolution
