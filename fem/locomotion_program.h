#pragma once

#include <filesystem>
#include <functional>

#include "fem/locomotion_dynamics.h"

namespace menger::fem {

/// How one of the programs of `menger locomote` moves bodies.
struct LocomotionMethod {
  bool is_implicit = false;
  LocomotionMaker make;
  /// What becomes of a study of the other method: the exit code, unless another program takes the place of this one.
  std::function<int(const std::filesystem::path& study)> pass_on;
};

/// Reads the arguments and the study, runs it or its sweep, and says how it went. @return the exit code
/// @throws io::InputError for wrong input
int locomotion_program(int argc, const char* const* argv, const LocomotionMethod& method);

}  // namespace menger::fem
