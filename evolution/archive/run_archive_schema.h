#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace menger::evolution {

/// Refuses an archive. @throws io::InputError with the file and the reason
[[noreturn]] void refuse_archive(const std::filesystem::path& file, const std::string& reason);

/// Checks the first bytes of a file. SQLite alone would accept any short file as an empty database.
/// @throws io::InputError if they are not those of an SQLite database
void require_database_header(const std::filesystem::path& file);

/// Returns whether a database is empty, for example because a process died while it made an archive.
bool is_empty_database(SQLite::Database& connection);

/// Makes the tables of an archive of the present version in an empty database, in one transaction.
void create_schema(SQLite::Database& connection, std::string_view study, int generations);

/// Makes the table of displacements before the part of an evaluation that counts, if it is missing. Only some searches need it;
/// the archives of others stay as they are.
void add_left_out_table(SQLite::Database& connection);

/// Makes the tables of displacements in every period and of the elements of bodies, if they are missing. Only some searches need
/// them.
void add_walk_tables(SQLite::Database& connection);

/// Makes the table of individuals that a surrogate screened, if it is missing. Only some searches need it.
void add_screening_table(SQLite::Database& connection);

/// Makes the table of scenarios, if it is missing. Only some searches need it.
void add_scenario_table(SQLite::Database& connection);

/// Makes the table of the order of a steady-state search, if it is missing. Only such searches need it.
void add_event_table(SQLite::Database& connection);

/// Makes the table of evaluations with half the time step, with the columns of `evaluation`, if it is missing. Only some searches
/// need it.
void add_step_check_table(SQLite::Database& connection);

/// Adds the tables of re-evaluations to an archive whose version has none, in one transaction.
void upgrade(SQLite::Database& connection);

/// Returns whether the study of an archive has earlier names of keys, so that its texts and hashes differ from the present ones.
bool has_earlier_keys(const SQLite::Database& connection);

/// Refuses an archive of an earlier version for continuing its search. The reason also says if finite elements corrected it.
/// @throws io::InputError
void require_present_keys(const std::filesystem::path& file, SQLite::Database& connection);

/// Checks that a database is an archive that this program can read.
/// @throws io::InputError if it is not an archive, has a version that this program does not read, or is damaged: also if rows
/// contradict each other, which SQLite's own check of the pages does not find
void require_archive(const std::filesystem::path& file, SQLite::Database& connection);

}  // namespace menger::evolution
