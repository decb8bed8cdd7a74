#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace menger::io {

/// Returns the SHA-256 of some bytes as 64 lower-case hexadecimal digits.
std::string content_hash(std::string_view bytes);

/// Returns the SHA-256 of the content of a file. @throws InputError if it cannot be read
std::string file_hash(const std::filesystem::path& file);

/// The hash of each file's content, by its path as given. @throws InputError if one cannot be read
std::map<std::string, std::string> file_hashes(std::span<const std::filesystem::path> files);

}  // namespace menger::io
