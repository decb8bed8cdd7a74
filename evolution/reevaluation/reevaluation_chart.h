#pragma once

#include "evolution/reevaluation/reevaluation_table.h"
#include "io/picture/chart.h"

namespace menger::evolution {

/// Draws two panels with a point per design that completed in both models: the speed on finite elements against that on the
/// surrogate (body lengths per minute, with the diagonal), and the angle between both directions against the speed on the
/// surrogate.
io::Chart scatter_chart(const ReevaluationStudy& study, const ReevaluationFindings& findings);

/// Draws the motion of a design in both models: its path seen from above, its distance from the start and the height of its
/// centre, both against time.
io::Chart trajectories_chart(const ReevaluationStudy& study, const ReevaluatedDesign& design);

}  // namespace menger::evolution
