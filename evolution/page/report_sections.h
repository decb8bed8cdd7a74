#pragma once

#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Makes the charts and tables of all outputs, a section per kind of result: inflation, walks, validation, calibration, load
/// cases, search, re-evaluation, natural frequencies, trade-off, and provenance last. A kind without outputs has no section.
/// @param notes gets a sentence for every file that cannot be read
std::vector<PageSection> report_sections(const std::vector<CommandOutput>& outputs, std::vector<std::string>& notes);

}  // namespace menger::evolution
