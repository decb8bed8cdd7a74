#pragma once

#include <string>

namespace menger::io {

/// The shortest decimal text that reads back as the same double, with a point in every locale.
std::string number_text(double value);

}  // namespace menger::io
