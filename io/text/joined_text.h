#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace menger::io {

/// Texts one after the other with a separator between each two, for messages; empty if there are none.
std::string joined(const std::vector<std::string>& texts, std::string_view separator = ", ");

}  // namespace menger::io
