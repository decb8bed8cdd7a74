#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/study/study.h"
#include "fem/explicit/material_damping.h"
#include "fem/thin_walls/element_choice.h"
#include "io/study/study_visitor.h"

namespace menger::evolution {

/// The finite elements that evaluate robots.
struct LocomotionOptions {
  fem::ElementChoice elements{};
  int elements_through_wall = 1;              ///< of three_field; thin walls have one
  double bulk_modulus_ratio = 50.0;           ///< bulk modulus / shear modulus, at rest
  double step_safety = 0.8;                   ///< time step / stable time step
  std::optional<double> youngs_modulus_Pa{};  ///< at rest; none: that of the silicone's record
  /// The damping model, as studies of `menger locomote` name it. Of three_field elements a viscosity gives more repeatable
  /// results: the displacement of a body then changes by some 5 % with the time step instead of 25 % (body stand18, at 0.6 to 0.9
  /// of the stable step). Thin walls would need steps a sixth as long with it.
  fem::DampingModel damping_model = fem::DampingModel::maxwell;
  double friction_factor = 1.0;  ///< factor on the friction of the ground, of a variant
  double pressure_factor = 1.0;  ///< factor on the pressures of the drive, of a variant
  int threads = 1;               ///< of one run

  bool operator==(const LocomotionOptions&) const = default;
};

/// Variants that show the error of the finite elements: the best designs are evaluated again, each time with one thing changed. A
/// variant that changes nothing is left out.
struct VariantOptions {
  std::size_t designs = 3;  ///< number of the best designs
  /// Whether finer elements are a variant: of thin walls the next fidelity, of three_field `elements_through_wall`.
  bool finer_elements = true;
  int elements_through_wall = 2;
  double bulk_modulus_factor = 2.0;                           ///< factor on LocomotionOptions::bulk_modulus_ratio
  double step_factor = 0.5;                                   ///< factor on LocomotionOptions::step_safety
  double friction_factor = 1.01;                              ///< factor on the friction of the ground
  double pressure_factor = 1.01;                              ///< factor on the pressures of the drive
  std::vector<double> youngs_moduli_Pa = {107'000, 264'000};  ///< lowest and highest value stated for the silicone
};

/// The model that finite elements are compared with.
enum class ComparedModel {
  search,  ///< that of the search
  voxels   ///< voxels with the parameters of the search, also if finite elements decided it
};
std::string_view to_string(ComparedModel model);  ///< "search" or "voxels"

/// Everything that decides how designs of an archive are evaluated again. Values that both models share (body, chambers,
/// pressure, ground) come from the archive.
struct ReevaluationStudy {
  std::filesystem::path archive;
  std::filesystem::path file;  ///< empty: all values are defaults
  Study search;                ///< of the archive; with the friction of the re-evaluation
  std::size_t top = 1;         ///< number of best designs, >= 1
  std::size_t sample = 0;      ///< number of designs drawn from the others
  std::uint64_t sample_seed = 1;
  int level = 1;
  ComparedModel compare_with = ComparedModel::search;
  double duration_s = 0.0;
  double measure_from_s = 0.0;  ///< time from which displacement counts in both models, a multiple of record_interval_s
  double record_interval_s = 0.02;
  double frame_interval_s = 0.1;        ///< of the design that is shown, a multiple of record_interval_s
  double least_body_lengths = 0.01;     ///< a design that moves less, in either model, has no direction
  double time_limit_s = 3600.0;         ///< wall time of a run of finite elements, over all calls
  std::filesystem::path silicone_file;  ///< may be empty for a search on finite elements, which has its silicone
  LocomotionOptions elements;
  std::optional<VariantOptions> variants;
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read

  /// Returns whether the finite elements of the search are compared with those of the re-evaluation, and not voxels.
  [[nodiscard]] bool compares_elements() const { return uses_elements(search) && compare_with == ComparedModel::search; }

  /// Returns the time in which a measured displacement is made.
  [[nodiscard]] double measured_s() const {
    const auto last = measured_periods(search);
    return last ? last->period_s : duration_s - measure_from_s;
  }
};

/// What a caller gives to read a study of re-evaluation.
struct ReevaluationRequest {
  std::filesystem::path archive;
  std::filesystem::path file;  ///< of the study; may be empty
  std::size_t top = 1;         ///< see ReevaluationStudy
  std::size_t sample = 0;      ///< see ReevaluationStudy
};

/// Describes the keys of a study of re-evaluation, for people: `menger reevaluate --keys`. If a file does not give the level,
/// times or friction, they are those of the search: `study.search`.
void describe(io::StudyVisitor& visitor, ReevaluationStudy& study);

/// Reads a study of re-evaluation.
///
/// Of a search on finite elements the re-evaluation takes silicone, elements and step, but the fidelity is `standard` if the file
/// does not give another.
/// @throws io::InputError with file, key and value; also if the search has neither finite elements nor a calibrated surrogate
/// that is driven by pressure, has no such level, has two materials of different friction, or is of another silicone than the
/// study
ReevaluationStudy read_reevaluation_study(const ReevaluationRequest& request, const RunArchive& archive);

/// Does the same for the study of a search. @param request its `archive` is for messages
ReevaluationStudy read_reevaluation_study(const ReevaluationRequest& request, const Study& search);

/// Returns everything that decides the results, as text for the manifest.
std::string resolved_text(const ReevaluationStudy& study);

}  // namespace menger::evolution
