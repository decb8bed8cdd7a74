#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/toml_document.h"

namespace menger::materials {

/// The file of the silicone that a key of a table names: either a path (with "/" or ending in .toml, relative to the file of the
/// table), or the name of a record of menger, such as "dragon_skin_10". Records are those of the source tree that the program
/// was built from.
/// @param fallback name where the key is missing; empty: the key must be there
/// @throws io::InputError naming the key and the records there are, for a name that is none of them; and as TomlTable does for a
/// key that is missing or no text
std::filesystem::path silicone_file(const io::TomlTable& table, std::string_view key, const std::string& fallback = "");

/// The file of a record of menger; nothing if there is none of that name.
std::optional<std::filesystem::path> silicone_of_menger(std::string_view name);

}  // namespace menger::materials
