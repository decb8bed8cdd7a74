#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "evolution/page/command_outputs.h"
#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Reads the motions that outputs have: walks, in both models on one clock where a body walks in both, inflations, the worst case
/// of a validation, the winner of a re-evaluation, and the champion of a search at all its levels.
/// @param most_bytes that all scenes together may take
/// @param notes gets a sentence for every motion that cannot be shown
std::vector<PageScene> read_scenes(const std::vector<CommandOutput>& outputs, std::size_t most_bytes,
                                   std::vector<std::string>& notes);

}  // namespace menger::evolution
