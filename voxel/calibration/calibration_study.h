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

/// A curve of a study and its origin.
struct StudyCurve {
  meshes::ResponseCurve curve;
  std::filesystem::path file;  ///< of the provenance
  std::string hash;            ///< of the provenance file, which holds the hash of the table
  std::string table_hash;      ///< of the table beside it
  double weight = 1.0;
};

/// Properties that all curves of a study must share.
struct CurveSubject {
  std::string silicone{};
  std::optional<std::string> law{};  ///< nothing: that of the curves
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
};

/// A calibration study: which parameters to fit to which curves.
struct CalibrationStudy {
  std::filesystem::path file{};
  std::vector<std::filesystem::path> places{};  ///< provenance files of response curves, and folders of them
  /// Names of the cases to fit, all of which must exist; nothing: all cases.
  std::optional<std::vector<std::string>> cases{};
  std::optional<std::string> silicone{};  ///< name or file of the record with the loss data
  CurveSubject subject{};
  int voxels_per_cell = 1;
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;
  std::map<meshes::LoadCaseKind, double> weights{};  ///< factors on squared residuals; 1 for kinds that are missing
  CalibrationBounds bounds{};                        ///< bounds that the study sets
  CalibrationPlan plan{};
  /// States at other pressures are left out of the fit, and so of its range of validity.
  std::optional<ValueRange> pressures_Pa{};
  std::optional<FrequencyReference> frequency_response{};  ///< to compare with, not to fit

  // Contents of the files that the study names.
  std::vector<StudyCurve> curves{};
  std::optional<materials::LossData> loss{};
  std::vector<std::string> notes{};             ///< sentences on the input for the user
  std::map<std::string, std::string> inputs{};  ///< files and content hashes
};

/// Describes the keys of a study; menger calibrate --keys lists them. Curves need not be given if the study already has them.
///
/// Weights are factors on squared residuals, in the sum that a fit minimises and in the criterion that chooses details. Reported
/// residuals, chi2 and intervals use the stated uncertainties alone, which are relative to the largest magnitudes within
/// pressures_Pa.
void describe(io::StudyVisitor& visitor, CalibrationStudy& study);

/// Reads a study from TOML, and the curves that it names.
/// @param curves files or folders to read in place of the study's, relative to the working folder, if any
/// @throws io::InputError with file, key and value; for missing cases, with all their names; with the name of the curve, for a
/// curve of another silicone, law, edge, wall or chamber layout than the study's, or for two curves of the same name
CalibrationStudy read_calibration_study(const std::filesystem::path& file, const std::vector<std::filesystem::path>& curves = {});

/// The calibration problem of a study: its curves, rough parameters to start from, and bounds.
CalibrationProblem problem_of(const CalibrationStudy& study, const Responder& responder);

/// Everything that decides the result of a study, defaults included, as TOML. Curves are represented by their hashes.
std::string study_text(const CalibrationStudy& study, const CalibrationProblem& problem);

}  // namespace menger::voxel
