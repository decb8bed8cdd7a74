#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "voxel/validation/validation_cause.h"
#include "voxel/validation/validation_study.h"
#include "voxel/validation/validation_summary.h"
#include "voxel/validation/volume_actuation.h"

namespace menger::voxel {

struct ValidationRunOptions {
  bool pictures = true;
  bool explain = false;  ///< look for the cause of what is missed, of every body of which something is claimed
  const std::atomic<bool>* stop = nullptr;
  /// Called as work goes on: what is done of 1, and what is being done. May be empty.
  std::function<void(double done, const std::string& note)> progress{};
};

/// What a run found, as it was written.
struct ValidationResult {
  io::RunStatus status = io::RunStatus::completed;  ///< not_converged where the surrogate has no answer to a state, or stopped
  std::vector<CurveComparison> comparisons;
  std::vector<VolumeActuation> actuations;  ///< of the bodies with an inflation curve
  ActuationAim actuation;
  std::vector<CauseReport> causes;  ///< of the bodies with numbers inside the range of validity; of the worst if there are none
  std::vector<std::string> notes;   ///< what the user should know, in sentences
};

/// Compares voxel parameters with curves and writes into a folder: errors.csv, summary.csv, volume_actuation.csv, report.txt
/// (what is printed), errors.png, curve_CASE.png, and of the worst body worst.pvd and worst.png; see validation_tables.h and
/// validation_scene.h. A stopped run writes nothing.
/// @param record of the fit of the parameters, for the notes
/// @throws io::InputError if the folder cannot be written to
ValidationResult run_validation(const ValidationStudy& study, const SurrogateParameters& parameters, const FitRecord& record,
                                const std::vector<HeldOutCurve>& curves, const std::filesystem::path& folder,
                                const ValidationRunOptions& options);

/// What there is to say of a result, line by line: summary, aim, actuation, cause, notes.
std::vector<std::string> report_lines(const ValidationResult& result, double aim);

}  // namespace menger::voxel
