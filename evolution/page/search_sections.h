#pragma once

#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Adds the progress of a search, its lineage and its best robots.
void add_search(const CommandOutput& output, const std::vector<CommandOutput>& outputs, PageSection& section);

/// Adds the ranking of a re-evaluation, and its robots.
void add_reevaluation(const CommandOutput& output, PageSection& section);

/// Adds the walks of a confirmation.
void add_confirmation(const CommandOutput& output, PageSection& section);

}  // namespace menger::evolution
