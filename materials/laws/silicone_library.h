#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/toml_document.h"

namespace menger::materials {

/// Returns the file of the silicone that a key of a table names. The value is either a path (with "/" or ending in .toml,
/// relative to the file of the table) or the name of a record of menger, such as "dragon_skin_10". Records lie
/// in the data folder of menger (io::data_folder).
/// @param fallback name to use if the key is missing; empty: the key is required
/// @throws io::InputError naming the key and the known records if the name is not among them, or if it is a CSV file; like
/// TomlTable if the key is missing or not a text
std::filesystem::path silicone_file(const io::TomlTable& table, std::string_view key, const std::string& fallback = "");

/// Returns the file of a record of menger; nothing if there is none of that name.
std::optional<std::filesystem::path> silicone_of_menger(std::string_view name);

/// Returns the file of the record of menger that names its silicone so ("Dragon Skin 10"); nothing if there is none.
std::optional<std::filesystem::path> silicone_with_record_name(std::string_view name);

}  // namespace menger::materials
