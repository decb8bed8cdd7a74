#pragma once

#include "tests/extremes/row.h"

namespace menger::extremes {

/// The rows of the one part that a program is linked with.
Part part();

}  // namespace menger::extremes
