#pragma once

#include <string>
#include <vector>

#include "materials/tensile_test.h"

namespace menger::materials {

/// Repairs the known faults of a record and tells of each repair, one sentence each.
///
/// - The clock: where times do not rise by one and the same interval they are counted anew from the first, at the median
/// interval.
/// - The failure tail: rows after the highest stress are left out.
/// - Drop-outs: from a fall of the stress on that cannot be noise (more than 0.1 % of the highest stress, and five times the
/// median
///   change of slope) the specimen is no longer whole, and the rows are left out.
/// - The zero of the load: a constant and a Mooney-Rivlin law are fitted to the rows up to a strain of 0.5, and the constant is
///   taken off. Less than 0.5 % of the stress at that strain is left alone.
std::vector<std::string> clean(TensileTest& test);

/// Divides the strain by a factor > 1: crosshead travel by the gauge length counts the shoulders of the specimen as if they were
/// gauge.
/// @return the sentence that tells so
std::string correct_crosshead_strain(TensileTest& test, double factor);

}  // namespace menger::materials
