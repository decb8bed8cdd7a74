#pragma once

#include "evolution/reevaluation/reevaluation_table.h"
#include "io/picture/chart.h"

namespace menger::evolution {

/// Body lengths per minute, surrogate across, finite elements up, a point per design that completed in both, with the diagonal;
/// beside it the angle between both directions by the surrogate's speed.
io::Chart scatter_chart(const ReevaluationStudy& study, const ReevaluationFindings& findings);

/// A design in both models: its path seen from above, how far it is from its start, and how high its centre is.
io::Chart trajectories_chart(const ReevaluationStudy& study, const JudgedDesign& design);

}  // namespace menger::evolution
