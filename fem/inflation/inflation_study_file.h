#pragma once

#include <filesystem>

#include "fem/inflation/inflation_study.h"

namespace menger::fem {

/// Reads a study of `menger inflate`, whose keys `menger inflate --keys` lists.
/// @throws io::InputError with file, key and value for wrong input, and for files that the study names and that cannot be read
InflationStudy read_inflation_study(const std::filesystem::path& file);

}  // namespace menger::fem
