#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace menger::evolution {

/// @throws io::InputError with the file and the reason
[[noreturn]] void refuse_archive(const std::filesystem::path& file, const std::string& reason);

/// Looks at the first bytes before SQLite does, since it would take any short file for an empty database.
/// @throws io::InputError if they are not those of an SQLite database
void require_database_header(const std::filesystem::path& file);

/// Whether a database holds nothing, as a process leaves it that died while it made an archive.
bool is_empty_database(SQLite::Database& connection);

/// Makes the tables of an archive of the present version in an empty database, in one transaction.
void create_schema(SQLite::Database& connection, std::string_view study, int generations);

/// Make a table that only some searches have, where it is missing: so the archives of others stay what they were. Of
/// displacements that were left out, of judgements, and of evaluations with half the time step, which has the columns of
/// `evaluation`.
void add_left_out_table(SQLite::Database& connection);
void add_judgement_table(SQLite::Database& connection);
void add_step_check_table(SQLite::Database& connection);

/// Gives an archive the tables of re-evaluations if its version had none, in one transaction.
void upgrade(SQLite::Database& connection);

/// Whether the study of an archive has keys of earlier names, so that its texts and their hashes are others than today's.
bool has_earlier_keys(const SQLite::Database& connection);

/// @throws io::InputError if has_earlier_keys
void require_present_keys(const std::filesystem::path& file, const SQLite::Database& connection);

/// @throws io::InputError if the database is no archive, is of a version that this menger does not read, or is damaged, also
/// where rows contradict each other, which the pages cannot show
void require_archive(const std::filesystem::path& file, SQLite::Database& connection);

}  // namespace menger::evolution
