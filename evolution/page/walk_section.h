#pragma once

#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Returns the section on all walks, in both models.
/// @param notes gets a sentence for every file that cannot be read
PageSection walk_section(const std::vector<CommandOutput>& outputs, std::vector<std::string>& notes);

}  // namespace menger::evolution
