#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace menger::io {

/// Joins texts with a separator between them, for messages. Empty if there are no texts.
std::string joined(const std::vector<std::string>& texts, std::string_view separator = ", ");

}  // namespace menger::io
