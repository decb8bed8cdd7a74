#pragma once

#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Adds the residuals of a calibration, and what was fitted.
void add_calibration(const CommandOutput& output, PageSection& section);

/// Adds the errors of a validation. @param loop which made it; null if none did
void add_validation(const CommandOutput& output, const CommandOutput* loop, PageSection& section);

}  // namespace menger::evolution
