#pragma once

#include <filesystem>
#include <functional>

#include "fem/locomotion/locomotion_run.h"

namespace menger::fem {

/// The method by which one of the programs of `menger locomote` moves bodies.
struct LocomotionMethod {
  bool is_implicit = false;
  LocomotionMaker make;
  /// Handles a study of the other method and returns the exit code, unless it replaces this program by the other one or throws.
  std::function<int(const std::filesystem::path& study)> pass_on;
  int process_count = 1;  ///< number of processes that were started together
  /// Runs an action that each of these processes does by itself, so that none continues if another has failed.
  std::function<void(const std::function<void()>& action)> on_every_process = [](const auto& action) { action(); };
  /// Called instead of a run on all processes but the first. Empty on the first.
  std::function<void(const LocomotionStudy& study)> help{};
};

/// Reads the arguments and the study, runs the study or its sweep, and prints the outcome.
/// @return the exit code
/// @throws io::InputError for wrong input
int locomotion_program(int argc, const char* const* argv, const LocomotionMethod& method);

}  // namespace menger::fem
