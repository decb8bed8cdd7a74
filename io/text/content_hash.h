#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace menger::io {

/// Returns the SHA-256 of some bytes as 64 lower-case hexadecimal digits.
std::string content_hash(std::string_view bytes);

/// Returns the SHA-256 of the content of a file. @throws InputError if it cannot be read
std::string file_hash(const std::filesystem::path& file);

/// Notes an input file for a manifest: its path as given, with the hash of its present content.
/// @throws InputError if it cannot be read
void note_input(std::map<std::string, std::string>& inputs, const std::filesystem::path& file);

/// Does the same for a file that was read before. @param content what was read
void note_input(std::map<std::string, std::string>& inputs, const std::filesystem::path& file, std::string_view content);

}  // namespace menger::io
