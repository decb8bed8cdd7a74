#pragma once

#include <array>

#include "evolution/evaluation/evaluator.h"
#include "meshes/load_cases/lean.h"

namespace menger::evolution {

/// Sets the result of a walk in which the body has fallen: it has no displacement. Where it got is kept, but counts for nothing.
/// An axis that is not a number leans infinitely: then the walk has diverged, and no place is known.
/// @param whole_m displacement from the start to the end of the walk
void set_fallen(const meshes::Lean& lean, const std::array<double, 3>& whole_m, Evaluation& result);

}  // namespace menger::evolution
