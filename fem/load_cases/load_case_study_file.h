#pragma once

#include <filesystem>

#include "fem/load_cases/load_case_study.h"

namespace menger::fem {

/// Reads a set of load cases, whose keys `menger load-cases --keys` lists.
/// @throws io::InputError with file, key and value for wrong input, and for files that the set names and that cannot be read
LoadCaseStudy read_load_case_study(const std::filesystem::path& file);

}  // namespace menger::fem
