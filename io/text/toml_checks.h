#pragma once

#include <filesystem>
#include <string_view>

namespace menger::io {

/// Checks that the tables and arrays of a TOML text lie at most 100 levels deep. To be called before the text is parsed: the
/// parser bounds nested arrays but not dotted keys, and both it and its tables need the stack for each level.
/// @param file source of the text, for the message
/// @throws InputError with file and line
void require_shallow_toml(std::string_view text, const std::filesystem::path& file);

/// Checks every number of a TOML text, also in tables that nothing else reads.
/// @param text that parse_toml accepts
/// @param file source of the text, for the message
/// @throws InputError with file, line, key and value for the first that is infinite or not a number
void require_finite_numbers(std::string_view text, const std::filesystem::path& file);

}  // namespace menger::io
