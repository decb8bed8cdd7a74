#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace menger::io {

/// Returns the word of a list that a mistyped word probably stands for: the one that the fewest changes of a letter lead to. At
/// most 3 changes are allowed, fewer for a short word. If no word is so near, it is the only one that goes on after the written
/// word and an underscore, since a unit may lack: frequency_Hz for frequency. Otherwise nothing.
std::optional<std::string> near_miss(std::string_view written, std::span<const std::string> words);

}  // namespace menger::io
