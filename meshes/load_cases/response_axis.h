#pragma once

#include <string>
#include <vector>

namespace menger::meshes {

/// Returns the title of an axis that columns of response curves share: that of the only one, or a word for several of one unit.
/// @param columns names that have the same unit, at least one
std::string response_axis_title(const std::vector<std::string>& columns);

}  // namespace menger::meshes
