#pragma once

#include <string_view>

namespace menger::io {

/// Returns the version of menger, e.g. "0.1.0".
std::string_view version();

}  // namespace menger::io
