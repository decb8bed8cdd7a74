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

/// Which parameters are to be compared with which response curves.
struct ValidationStudy {
  std::filesystem::path file{};
  std::filesystem::path parameters{};                 ///< voxel parameters (TOML)
  std::vector<std::filesystem::path> curves{};        ///< provenance files of curves, and folders of them
  std::optional<std::filesystem::path> load_cases{};  ///< set of load cases whose curves are made first
  double aim = 0.10;                                  ///< of the median errors in displacement and volume
  double actuation_pressure_Pa = 6000.0;              ///< at which the change of outer volume is stated, see volume_actuation.h
  double actuation_amplitude = 0.144714;  ///< of the edges of solid voxels, whose volumes change by (1 +- amplitude)^3 - 1
};

/// Places that the user names in place of those of a study.
struct ValidationPlaces {
  std::optional<std::filesystem::path> parameters{};
  std::vector<std::filesystem::path> curves{};
};

/// The keys of a study; menger validate --keys lists them. What a study has before need not be given.
void describe(io::StudyVisitor& visitor, ValidationStudy& study);

/// Reads a study. @param instead what it names may be missing in the file @throws io::InputError with file, key and value
ValidationStudy read_validation_study(const std::filesystem::path& file, const ValidationPlaces& instead = {});

/// Where the curves of the study's load cases are made: the first folder among its curves, or `fallback`, which is then added to
/// them. @throws io::InputError if the first entry of curves is a file
std::filesystem::path load_case_folder(ValidationStudy& study, const std::filesystem::path& fallback);

/// What a calibration says about where its parameters come from.
struct FitRecord {
  std::size_t curve_count = 0;          ///< 0: the parameters do not say what they were fitted to
  std::vector<std::string> hashes{};    ///< content hashes of the curves that were fitted, of provenances and tables
  std::vector<std::string> subjects{};  ///< what they are about, see meshes::subject_of; fewer than curves in older files
};

/// Reads `[[fit.curves]]` of voxel parameters, each with `name`, `hash`, and if stated `table_hash` and `subject`. @throws
/// io::InputError with file, key and value
FitRecord read_fit_record(const std::filesystem::path& parameters_file);

/// A curve and the file of its provenance.
struct HeldOutCurve {
  std::filesystem::path file;
  meshes::ResponseCurve curve;
};

/// Reads the curves of a study, those of a folder in the order of their names, each once. In a folder, every .toml with a .csv of
/// the same name beside it is one.
/// @throws io::InputError if a place is missing or holds none, for curves that read_response_curve refuses, for a curve of
/// another silicone, law, density, cell edge or wall than the parameters', for one that the parameters were fitted to (the same
/// provenance, the same table, or the same kind of load on the same body, whatever its name and its pressures), and for two of
/// the same name
std::vector<HeldOutCurve> read_held_out_curves(const ValidationStudy& study, const SurrogateParameters& parameters,
                                               const FitRecord& record);

}  // namespace menger::voxel
