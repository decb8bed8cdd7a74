#pragma once

#include <string>
#include <vector>

#include "materials/fit/tensile_test.h"

namespace menger::materials {

/// Repairs the known faults of a record. Returns a description of each repair, one sentence each.
///
/// - The clock: if times do not rise by a constant interval, they are counted again from the first time at the median interval.
/// - The failure tail: rows after the largest stress (in compression the most negative) are removed.
/// - Drop-outs: rows after a fall of the load that cannot be noise are removed, because the specimen is no longer whole. Such a
///   fall exceeds 0.1 % of the largest stress, and together with the rise that the steps around it have in the median it exceeds
///   five times the median change from one step of the stress to the next. Rows are also removed after a single step that is
///   larger or smaller than the three steps on each side of it, by more than 0.1 % of the largest stress and more than twenty
///   times that median. Up to a strain of 0.1 and in the first quarter of the rows it is the grips that settle: there the rows
///   before are removed.
/// - The zero of the load: a constant and a law that fits all silicones at small strain (Mooney-Rivlin and the second term of
///   Yeoh) are fitted to the rows up to a strain of 0.3. The constant is subtracted if it exceeds five standard errors and 0.5 %
///   of the stress there, and if the rows up to a strain of 0.15 give the same constant to within a fifth. Otherwise nothing is
///   subtracted. The sentences report it if the two constants differ, the rows begin above a strain of 0.1, or there are too few
///   rows. The first rows may be bent because the specimen settles in its grips, which passes for an error of the zero. So the
///   same is done without them, with strains of 0.1 to 1 and the third term of Yeoh. If the law holds there as well and the
///   constants differ, this one takes the place of the other. On a clean curve the misfit of the law does not lead to such a
///   constant: it is at most 0.3 kPa at a shear modulus of 50 kPa, and less than five standard errors.
/// - First rows of the wrong sign: leading rows in which the stress still has the opposite sign of the strain are removed.
std::vector<std::string> clean(TensileTest& test);

/// Divides the strain by a factor > 1. A strain computed from the travel of the crosshead divided by the gauge length is too
/// large: it treats the shoulders of the specimen as part of the gauge.
/// @return a sentence that describes the correction
std::string correct_crosshead_strain(TensileTest& test, double factor);

}  // namespace menger::materials
