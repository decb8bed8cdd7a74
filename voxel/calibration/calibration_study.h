#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/study/study_visitor.h"
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

/// What all curves of a study must agree with.
struct CurveSubject {
  std::string silicone{};
  std::optional<std::string> law{};  ///< nothing: as the curves have it
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
};

/// What to fit to which curves.
struct CalibrationStudy {
  std::filesystem::path file{};
  std::vector<std::filesystem::path> places{};      ///< provenance files of response curves, and folders of them
  std::optional<std::vector<std::string>> cases{};  ///< names of those to fit, all of which must be there; nothing: all
  std::optional<std::string> silicone{};            ///< name or file of the record that has the loss data
  CurveSubject subject{};
  int voxels_per_cell = 1;
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;
  std::map<meshes::LoadCaseKind, double> weights{};  ///< factors on squares of residuals; kinds that are not there have 1
  CalibrationBounds bounds{};                        ///< those that the study sets
  CalibrationPlan plan{};
  std::optional<ValueRange>
      pressures_Pa{};  ///< states under other pressures are left out of the fit and so of its range of validity
  std::optional<FrequencyReference> frequency_response{};  ///< to compare with, not to fit

  // what the files say that it names
  std::vector<StudyCurve> curves{};
  std::optional<materials::LossData> loss{};
  std::vector<std::string> notes{};             ///< what is to be known of the input, in sentences
  std::map<std::string, std::string> inputs{};  ///< files and content hashes
};

/// The keys of a study; menger calibrate --keys lists them. Curves that a study has before need not be given.
///
/// Weights are factors on the squares of residuals in what a fit minimises and in the criterion that chooses details; reported
/// residuals, chi2 and intervals are by the stated uncertainties alone, which go by the largest magnitudes within pressures_Pa.
void describe(io::StudyVisitor& visitor, CalibrationStudy& study);

/// Reads a study from TOML and the curves that it names.
/// @param curves in place of the study's, relative to the working folder, if there are any
/// @throws io::InputError with file, key and value; for missing cases naming them all; for curves of another silicone, law, edge,
/// wall or chamber layout than the study's, or two of the same name, naming the curve
CalibrationStudy read_calibration_study(const std::filesystem::path& file, const std::vector<std::filesystem::path>& curves = {});

/// The problem of a study: rough parameters to start from, and bounds.
CalibrationProblem problem_of(const CalibrationStudy& study, const Responder& responder);

/// Everything that decides the result of a study, defaults included, as TOML; of the curves their hashes.
std::string study_text(const CalibrationStudy& study, const CalibrationProblem& problem);

}  // namespace menger::voxel
