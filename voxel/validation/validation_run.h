#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "voxel/validation/kind_errors.h"
#include "voxel/validation/validation_cause.h"
#include "voxel/validation/validation_study.h"
#include "voxel/validation/validation_summary.h"
#include "voxel/validation/volume_actuation.h"

namespace menger::voxel {

struct ValidationRunOptions {
  bool pictures = true;
  bool explain = false;  ///< find the causes of errors, for every body with numbers inside the range of validity
  const std::atomic<bool>* stop = nullptr;
  /// Called as work proceeds, with the fraction done (0 to 1) and a note on the present work. May be empty.
  std::function<void(double done, const std::string& note)> progress{};
};

/// The results of a run, as written to files.
struct ValidationResult {
  io::RunStatus status = io::RunStatus::completed;  ///< not_converged if the surrogate has no response in a state, or stopped
  std::vector<CurveComparison> comparisons;
  std::vector<VolumeActuation> actuations;  ///< of the bodies with an inflation curve
  ActuationAim actuation;
  ExpectedErrors expected;  ///< of the parameters, by kind of body
  /// For the bodies with numbers inside the range of validity; if there are none, for the worst body.
  std::vector<CauseReport> causes;
  std::vector<std::string> notes;  ///< sentences for the user
};

/// Compares voxel parameters with curves and writes the results into a folder: errors.csv, summary.csv, signs.csv,
/// expected_errors.csv, volume_actuation.csv, report.txt (the printed text), errors.png, curve_CASE.png, and worst.pvd and
/// worst.png of the state that is furthest_off(). See validation_tables.h, kind_errors.h and validation_scene.h. A stopped run
/// writes nothing.
/// @param record of the fit of the parameters, for the notes
/// @throws io::InputError if the folder cannot be written to
ValidationResult run_validation(const ValidationStudy& study, const SurrogateParameters& parameters, const FitRecord& record,
                                const std::vector<HeldOutCurve>& curves, const std::filesystem::path& folder,
                                const ValidationRunOptions& options);

/// The text lines that report a result: summary, aim, actuation, cause, notes.
std::vector<std::string> report_lines(const ValidationResult& result, double aim);

}  // namespace menger::voxel
