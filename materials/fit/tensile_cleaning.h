#pragma once

#include <string>
#include <vector>

#include "materials/fit/tensile_test.h"

namespace menger::materials {

/// Repairs the known faults of a record and tells of each repair, one sentence each.
///
/// - The clock: where times do not rise by one and the same interval they are counted anew from the first, at the median
/// interval.
/// - The failure tail: rows after the largest stress (in compression the most negative) are left out.
/// - Drop-outs: from a fall of the load on that cannot be noise (more than 0.1 % of the largest stress, and five times the median
///   change from one step of the stress to the next) the specimen is no longer whole, and the rows are left out. So are those
///   after a single step that is larger or smaller than the three on each side of it by more than 0.1 % of the largest stress and
///   twenty times that median.
/// - The zero of the load: a constant and a law that follows all silicones at small strain (Mooney-Rivlin and the second term of
///   Yeoh) are fitted to the rows up to a strain of 0.3. The constant is taken off if it is more than five standard errors and
///   0.5 % of the stress there, and the rows up to 0.15 give the same to a fifth; if they do not, or the rows begin above a
///   strain of 0.1 or are too few, that is told and nothing is taken off. On a clean curve the misfit of the law is no such
///   constant: at most 0.3 kPa at a shear modulus of 50 kPa, and less than five standard errors.
std::vector<std::string> clean(TensileTest& test);

/// Divides the strain by a factor > 1: crosshead travel by the gauge length counts the shoulders of the specimen as if they were
/// gauge.
/// @return the sentence that tells so
std::string correct_crosshead_strain(TensileTest& test, double factor);

}  // namespace menger::materials
