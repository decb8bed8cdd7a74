#pragma once

namespace menger::materials {

/// The number that the absolute value of Student's t exceeds with a probability of 5 %, to 1e-6 relative.
/// @param freedom degrees of freedom, at least 1
double student_quantile_95(int freedom);

}  // namespace menger::materials
