#pragma once

#include <filesystem>
#include <vector>

#include "evolution/outputs/command_outputs.h"
#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Returns what the results were computed from, by their manifests: body, cells, walls, silicone with the source of its law,
/// pressure, frequency, friction, damping, elements and voxel parameters. Where results differ in one of these, each value has
/// its folders. Without rows if the manifests state nothing.
/// @param folder of the report, from which relative paths of input files are looked for, too
PageTable input_table(const std::vector<CommandOutput>& outputs, const std::filesystem::path& folder);

}  // namespace menger::evolution
