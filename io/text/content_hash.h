#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace menger::io {

/// SHA-256 of some bytes as 64 lower-case hexadecimal digits.
std::string content_hash(std::string_view bytes);

/// SHA-256 of a file's bytes. @throws InputError if it cannot be read
std::string file_hash(const std::filesystem::path& file);

}  // namespace menger::io
