#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/study/study.h"
#include "io/study/study_visitor.h"

namespace menger::evolution {

/// Finite elements that judge.
struct LocomotionOptions {
  int elements_through_wall = 1;
  double bulk_modulus_ratio = 50.0;           ///< bulk by shear modulus at rest
  double step_safety = 0.9;                   ///< of the stable step
  std::optional<double> youngs_modulus_Pa{};  ///< at rest; none: that of the record
  /// As studies of `menger locomote` name it. Not their default: with a viscosity how far a body walks depends on the step by
  /// some 5 % instead of 25 % (stand18, at 0.6 to 0.9 of the stable step), and a judge has to say the same of a robot every time.
  std::string damping_model = "kelvin_voigt";
  int threads = 1;  ///< of one run

  bool operator==(const LocomotionOptions&) const = default;
};

/// How well the judge is known: the best designs are judged again, each time with one thing different. What is no different from
/// the judge itself is left out.
struct JudgeOptions {
  std::size_t designs = 3;                                    ///< the best ones
  int elements_through_wall = 2;                              ///< instead of the judge's own
  double bulk_modulus_factor = 2.0;                           ///< on the judge's own ratio
  double step_factor = 0.5;                                   ///< on the judge's own step
  std::vector<double> youngs_moduli_Pa = {107'000, 264'000};  ///< what is stated of the silicone, lowest and highest
};

/// All that decides how designs of an archive are judged again. What the search and the judge share (body, chambers, pressure,
/// ground) comes from the archive.
struct ReevaluationStudy {
  std::filesystem::path archive;
  std::filesystem::path file;  ///< empty: nothing but defaults
  Study search;                ///< of the archive; friction as it is judged
  std::size_t top = 1;         ///< best designs, >= 1
  std::size_t sample = 0;      ///< of the others
  std::uint64_t sample_seed = 1;
  int level = 1;
  double duration_s = 0.0;
  double measure_from_s = 0.0;  ///< displacement counts from then on in both models, a multiple of record_interval_s
  double record_interval_s = 0.02;
  double frame_interval_s = 0.1;     ///< of the shown design, a multiple of record_interval_s
  double least_body_lengths = 0.01;  ///< a design that moves less, in either model, has no direction
  double time_limit_s = 3600.0;      ///< of a run of finite elements, over all calls
  std::filesystem::path silicone_file;
  LocomotionOptions elements;
  std::optional<JudgeOptions> judge;
  std::map<std::string, std::string> inputs;  ///< content hash of every file that was read

  [[nodiscard]] double measured_s() const { return duration_s - measure_from_s; }
};

/// What is asked for beside the files.
struct ReevaluationRequest {
  std::filesystem::path archive;
  std::filesystem::path file;  ///< of the study; may be empty
  std::size_t top = 1;
  std::size_t sample = 0;
};

/// The keys of a study of re-evaluation, for people: `menger reevaluate --keys`. What a file does not give of level, times and
/// ground is the search's, which a reader finds in the study.
void describe(io::StudyVisitor& visitor, ReevaluationStudy& study);

/// Reads a study of re-evaluation.
/// @throws io::InputError with file, key and value; also if the search was not on a calibrated surrogate that is driven by
/// pressure, has no such level, has two materials of different friction, or calibrated another silicone than the study names
ReevaluationStudy read_reevaluation_study(const ReevaluationRequest& request, const RunArchive& archive);

/// The same for a search by its study. @param request with the search's file for messages in place of the archive
ReevaluationStudy read_reevaluation_study(const ReevaluationRequest& request, const Study& search);

/// Everything that decides the results, as text for the manifest.
std::string resolved_text(const ReevaluationStudy& study);

}  // namespace menger::evolution
