#pragma once

#include <string>

#include "io/study/study_visitor.h"

namespace menger::io {

/// Returns why no model bears a number of a study; empty if there is no reason. It goes by the unit at the end of the key's name:
/// a frequency of 1e300 Hz or a wall of 1e-200 m is a slip of the pen, and squares and quotients of it are no numbers any more.
/// The bounds lie far beyond every body and drive. A number that may be negative has no lower one.
std::string fault_of_magnitude(const StudyEntry& entry, double value);

}  // namespace menger::io
