#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/study/study_visitor.h"
#include "meshes/load_cases/response_curve.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// A validation study: which parameters to compare with which response curves.
struct ValidationStudy {
  std::filesystem::path file{};
  std::filesystem::path parameters{};                 ///< voxel parameters (TOML)
  std::vector<std::filesystem::path> curves{};        ///< provenance files of curves, and folders of them
  std::optional<std::filesystem::path> load_cases{};  ///< set of load cases whose curves are computed first
  double aim = 0.10;                                  ///< of the median errors in displacement and volume
  double actuation_pressure_Pa = 6000.0;              ///< at which the change of outer volume is reported, see volume_actuation.h
  /// Of the edges of solid voxels; their volumes change by (1 +- amplitude)^3 - 1.
  double actuation_amplitude = 0.144714;
};

/// Files and folders that the user names in place of those of a study.
struct ValidationPlaces {
  std::optional<std::filesystem::path> parameters{};
  std::vector<std::filesystem::path> curves{};
};

/// Describes the keys of a study; menger validate --keys lists them. A key need not be given if the study already has its value.
void describe(io::StudyVisitor& visitor, ValidationStudy& study);

/// Reads a study. @param instead the file need not name what is given here @throws io::InputError with file, key and value
ValidationStudy read_validation_study(const std::filesystem::path& file, const ValidationPlaces& instead = {});

/// The folder into which the curves of the study's load cases are computed: the first folder among its curves, or `fallback`,
/// which is then added to them. @throws io::InputError if the first entry of curves is a file
std::filesystem::path load_case_folder(ValidationStudy& study, const std::filesystem::path& fallback);

/// The record of a calibration in a file of parameters: the curves that they were fitted to.
struct FitRecord {
  std::size_t curve_count = 0;        ///< 0: the file does not record them
  std::vector<std::string> hashes{};  ///< content hashes of the fitted curves, of provenances and tables
  /// Subjects of the fitted curves, see meshes::subject_of; older files have fewer subjects than curves.
  std::vector<std::string> subjects{};
};

/// Reads `[[fit.curves]]` of voxel parameters. Each entry has `name`, `hash`, and optionally `table_hash` and `subject`.
/// @throws io::InputError with file, key and value
FitRecord read_fit_record(const std::filesystem::path& parameters_file);

/// A curve to compare with, and the file of its provenance.
struct HeldOutCurve {
  std::filesystem::path file;
  meshes::ResponseCurve curve;
};

/// Reads the curves of a study, each once; those of a folder in the order of their names. In a folder, every .toml with a .csv of
/// the same name beside it is a curve.
/// @throws io::InputError if a place is missing or holds no curve; for a curve that read_response_curve refuses; for a curve of
/// another silicone, law, density, cell edge or wall than that of the parameters; for a curve that the parameters were fitted to
/// (the same provenance, the same table, or the same kind of load on the same body, for any name and pressures); and for two
/// curves of the same name
std::vector<HeldOutCurve> read_held_out_curves(const ValidationStudy& study, const SurrogateParameters& parameters,
                                               const FitRecord& record);

}  // namespace menger::voxel
