#pragma once

#include "fem/walk/walk_drive.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// Describes the keys of a drive.
void describe(io::StudyVisitor& visitor, SurrogateDrive& drive);

}  // namespace menger::fem
