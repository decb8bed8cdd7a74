#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "voxel/calibration/calibration_study.h"
#include "voxel/calibration/identifiability.h"

namespace menger::voxel {

struct CalibrationRunOptions {
  bool pictures = true;
  int identifiability_fits = 0;  ///< 0: not tested
  const std::atomic<bool>* stop = nullptr;
  /// Called as work proceeds, with the fraction done (0 to 1) and a note on the present work. May be empty.
  std::function<void(double done, const std::string& note)> progress{};
};

/// The results of a run, as written to files.
struct CalibrationRunResult {
  Calibration calibration;
  std::vector<FittedCurve> curves;
  std::optional<Identifiability> identifiability;
  std::vector<FrequencyGain> frequency_response;  ///< empty if the study has no reference or the fit was stopped
  std::vector<std::string> notes;                 ///< of the study and of pictures that could not be made
};

/// Fits a study and writes the results into a folder: parameters.toml (voxel parameters, for scenes and searches), result.toml,
/// details.csv, parameters.csv, correlation.csv, residuals.csv, responses.csv, identifiability.csv and frequency_response.csv if
/// asked for, curve_CASE.png and agreement.png, manifest.json.
///
/// A fit that did not converge is written with its status. A fit that is stopped writes nothing, and leaves the results of an
/// earlier run in the folder. Otherwise these are removed before any are written, so all results there are of this run.
/// @throws io::InputError if the folder cannot be written to or the frequency reference cannot be read; then nothing is removed
CalibrationRunResult run_calibration(const CalibrationStudy& study, const Responder& responder,
                                     const std::filesystem::path& folder, const CalibrationRunOptions& options);

}  // namespace menger::voxel
