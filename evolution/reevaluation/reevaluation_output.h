#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evolution/reevaluation/reevaluation_table.h"

namespace menger::evolution {

/// Writes tables, pictures and the winner's scene of a re-evaluation into a folder (see reevaluate), each file whole or not at
/// all; those of an earlier one go first.
/// @param notes gets what could not be drawn or shown @throws io::InputError if the place cannot be written
void write_reevaluation(const ReevaluationStudy& study, const std::filesystem::path& folder, bool pictures,
                        const ReevaluationFindings& findings, std::vector<std::string>& notes);

}  // namespace menger::evolution
