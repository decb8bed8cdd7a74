#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Returns that what is shown between the frames of a body is a guess, where too few of them are shown; otherwise an empty text.
/// @param body with its shown frames, at least one @param frames of its walk @param frequency_Hz of its strokes; 0 if not known
std::string guess_text(const PageBody& body, std::size_t frames, double frequency_Hz);

/// Reads the motions that outputs have: walks, in both models on one clock where a body walks in both, inflations, the worst case
/// of a validation, the winner of a re-evaluation, and the champion of a search at all its levels.
/// @param most_bytes that all scenes together may take
/// @param notes gets a sentence for every motion that cannot be shown
std::vector<PageScene> read_scenes(const std::vector<CommandOutput>& outputs, std::size_t most_bytes,
                                   std::vector<std::string>& notes);

}  // namespace menger::evolution
