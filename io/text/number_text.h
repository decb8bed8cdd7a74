#pragma once

#include <string>

namespace menger::io {

/// Returns the shortest decimal text that reads back as the same double. The decimal sign is a point in every locale.
std::string number_text(double value);

}  // namespace menger::io
