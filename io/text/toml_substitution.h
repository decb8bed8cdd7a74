#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace menger::io {

/// Returns a copy of a TOML text with the value of one number replaced. Every other character stays, so that error messages about
/// the copy name the right lines.
/// @param key path of the number through tables: "ground.static_friction"
/// @param file the file that the text is from, for error messages
/// @throws InputError naming file and key if the text is not TOML or has no number there
std::string with_number(std::string_view text, std::string_view key, double value, const std::filesystem::path& file);

}  // namespace menger::io
