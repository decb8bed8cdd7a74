#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/text/toml_document.h"

namespace menger::evolution {

/// Returns what a result file holds; nothing if it is not there. @throws io::InputError if it cannot be read
std::optional<io::TomlTable> table_at(const std::filesystem::path& file);

/// Returns status and reason of a result that did not complete, "diverged: too fast"; empty if it did.
std::string early_end(const io::TomlTable& result);

/// Returns the last line of a log that begins with some text; empty if there is none.
std::string log_line(const std::filesystem::path& log, const std::string& beginning);

}  // namespace menger::evolution
