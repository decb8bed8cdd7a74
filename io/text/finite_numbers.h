#pragma once

#include <filesystem>

namespace menger::io {

/// Checks every number of a TOML file, also in tables that nothing else reads.
/// @throws InputError with file, line, key and value for the first that is infinite or not a number, and if the file cannot be
/// read or is not TOML
void require_finite_numbers(const std::filesystem::path& file);

}  // namespace menger::io
