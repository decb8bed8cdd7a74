#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "materials/laws/silicone_record.h"
#include "meshes/load_cases/response_curve.h"
#include "voxel/calibration/calibration.h"
#include "voxel/calibration/calibration_frequency.h"

namespace menger::voxel {

/// A curve of a study, with where it came from.
struct StudyCurve {
  meshes::ResponseCurve curve;
  std::filesystem::path file;  ///< of the provenance
  std::string hash;            ///< of that file, which holds the hash of the table
  std::string table_hash;      ///< of the table beside it
  double weight = 1.0;
};

/// What to fit to which curves.
struct CalibrationStudy {
  std::filesystem::path file;
  std::vector<StudyCurve> curves;
  int voxels_per_cell = 1;
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;
  CalibrationBounds bounds;  ///< those that the study sets
  CalibrationPlan plan;
  std::optional<ValueRange>
      pressures_Pa;  ///< states under other pressures are left out of the fit and so of its range of validity
  std::optional<materials::LossData> loss;
  std::optional<FrequencyReference> frequency_response;  ///< to compare with, not to fit
  std::vector<std::string> notes;                        ///< what is to be known of the input, in sentences
  std::map<std::string, std::string> inputs;             ///< files and content hashes
};

/// Reads a study from TOML and the curves that it names:
/// - `curves`: provenance files of response curves, or folders of them (relative to the study file)
/// - `cases`: names of the load cases to fit, all of which must be there; without it all curves are fitted
/// - `record`: file of the silicone's record, for its loss data (optional)
/// - `[holds_for]` silicone, cell_edge_m, wall_thickness_m; law (optional: as the curves have it), chambers ("single", or
///   "per-phase"), voxels_per_cell (1)
/// - `[fit]` details (all, in the order in which they are tried), choice (by Akaike's criterion), aic_margin (10), loss
/// ("squares" or "cauchy"), loss_scale (3, in
///   standard deviations), largest_iteration_count (100), pressures_Pa (two numbers, lowest <= 0 <= highest: fit to states within
///   them only; uncertainties then go by the largest magnitudes there)
/// - `[weights]` of load cases by kind (1): factors on the squares of residuals in what a fit minimises and in the criterion that
///   chooses details; reported residuals, chi2 and intervals are by the stated uncertainties alone
/// - `[bounds]` two numbers by quantity, see quantity_words (default_bounds)
/// - `[frequency_response]` file, column, cells, digits, level (1), pressure_Pa (0), end ("tip", "top"): see FrequencyReference
/// @param curves in place of the study's, relative to the working folder, if there are any
/// @throws io::InputError with file, key and value; for missing cases naming them all; for curves of another silicone, law, edge,
/// wall or chamber layout than the study's, or two of the same name, naming the curve
CalibrationStudy read_calibration_study(const std::filesystem::path& file, const std::vector<std::filesystem::path>& curves = {});

/// The problem of a study: rough parameters to start from, and bounds.
CalibrationProblem problem_of(const CalibrationStudy& study, const Responder& responder);

/// Everything that decides the result of a study, defaults included, as TOML.
std::string study_text(const CalibrationStudy& study, const CalibrationProblem& problem);

}  // namespace menger::voxel
