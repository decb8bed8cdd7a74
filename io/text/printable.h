#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace menger::io {

/// Returns a text as it may be shown on a terminal. Line breaks, tabs and printable characters of UTF-8 stay. Control characters
/// and those that change the direction of writing become `\u001B`, bytes that are not UTF-8 become `\xFF`: a text from a file
/// must not move the cursor, hide what was written before or start a command of the terminal.
///
/// Applied twice it changes nothing more.
std::string printable(std::string_view text);

/// Returns the number of bytes at the end of a text that begin a character of UTF-8 without completing it: 0 to 3.
std::size_t unfinished_bytes(std::string_view text);

}  // namespace menger::io
