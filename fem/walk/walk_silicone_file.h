#pragma once

#include "fem/walk/walk_silicone.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// Describes the keys of a silicone.
void describe(io::StudyVisitor& visitor, WalkSilicone& silicone);

}  // namespace menger::fem
