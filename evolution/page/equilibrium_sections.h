#pragma once

#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Adds pressure against volume of every plenum of an inflation, with the limit pressures.
void add_inflation(const CommandOutput& output, PageSection& section);

/// Adds the natural frequencies over the pressure, and the response to harmonic pressure.
void add_modes(const CommandOutput& output, PageSection& section);

/// Adds a table of the load cases of a folder, and how each ended.
void add_load_cases(const CommandOutput& output, PageSection& section);

}  // namespace menger::evolution
