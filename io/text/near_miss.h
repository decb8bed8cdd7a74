#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace menger::io {

/// The word of a list that somebody may have meant who wrote another: the one that fewest changes of a letter lead to, if these
/// are at most 3, and fewer for a short word.
std::optional<std::string> near_miss(std::string_view written, std::span<const std::string> words);

}  // namespace menger::io
