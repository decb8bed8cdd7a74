#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <string_view>

namespace menger::evolution {

/// Whether a database holds nothing, as a process leaves it that died while it made an archive.
bool is_empty_database(SQLite::Database& connection);

/// Makes the tables of an archive of the present version in an empty database, in one transaction.
void create_schema(SQLite::Database& connection, std::string_view study, int generations);

/// Brings an archive of an older version that require_archive takes to the present one, in one transaction.
void upgrade(SQLite::Database& connection);

/// @throws io::InputError if the database is no archive, is of a version that this menger does not read, or is damaged, also
/// where rows contradict each other, which the pages cannot show
void require_archive(const std::filesystem::path& file, SQLite::Database& connection);

}  // namespace menger::evolution
