#pragma once

#include <filesystem>
#include <functional>

#include "fem/locomotion/locomotion_dynamics.h"

namespace menger::fem {

/// How one of the programs of `menger locomote` moves bodies.
struct LocomotionMethod {
  bool is_implicit = false;
  LocomotionMaker make;
  /// What becomes of a study of the other method: the exit code, unless another program takes the place of this one.
  std::function<int(const std::filesystem::path& study)> pass_on;
  int process_count = 1;  ///< that were started together
  /// Runs what each of these processes does by itself, so that none goes on where another failed.
  std::function<void(const std::function<void()>& action)> on_every_process = [](const auto& action) { action(); };
  /// In place of a run, on all processes but the first. Nothing: this is the first.
  std::function<void(const LocomotionStudy& study)> help{};
};

/// Reads the arguments and the study, runs it or its sweep, and says how it went. @return the exit code
/// @throws io::InputError for wrong input
int locomotion_program(int argc, const char* const* argv, const LocomotionMethod& method);

}  // namespace menger::fem
