#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace menger::io {

/// A TOML text in which one number has another value; every other character stays, so that messages still name the right lines.
/// @param key path of the number through tables, "ground.static_friction"
/// @param file that the text came from, for messages
/// @throws InputError naming file and key if the text is no TOML or has no number there
std::string with_number(std::string_view text, std::string_view key, double value, const std::filesystem::path& file);

}  // namespace menger::io
