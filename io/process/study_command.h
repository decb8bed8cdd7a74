#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace menger::io {

/// The command whose study a file looks like, where that is another one than the program that was given it: "inflate", or
/// nothing.
///
/// All keys of the top table must be keys of exactly one command, and at least one of them none of the program's. The file of a
/// robot is the study of no command here: programs know it.
/// @param program "menger-simulate"
std::string command_of_study(const std::filesystem::path& file, std::string_view program);

/// The top keys and tables of the studies of a command, each with a space after it; empty if it reads no such studies.
/// @param command "simulate"; a test compares them with what --schema prints
std::string_view top_keys_of(std::string_view command);

}  // namespace menger::io
