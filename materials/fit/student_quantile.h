#pragma once

namespace menger::materials {

/// Returns the number that the absolute value of Student's t exceeds with a probability of 5 %.
/// @param freedom degrees of freedom, at least 1
double student_quantile_95(int freedom);

}  // namespace menger::materials
