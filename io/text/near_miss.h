#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace menger::io {

/// Returns the word of a list that a mistyped word probably stands for: the one that the fewest changes of a letter lead to. At
/// most 3 changes are allowed, fewer for a short word. Returns nothing if no word is near enough.
std::optional<std::string> near_miss(std::string_view written, std::span<const std::string> words);

}  // namespace menger::io
