#pragma once

#include "tests/extremes/row.h"

namespace menger::extremes {

/// Returns the rows of the part that is linked to the program.
Part part();

}  // namespace menger::extremes
