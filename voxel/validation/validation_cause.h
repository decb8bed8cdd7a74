#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "voxel/model/surrogate_parameters.h"
#include "voxel/validation/validation.h"

namespace menger::voxel {

/// The parameters of a body that are fitted to it alone, in place of those of the calibration.
enum class OwnPart {
  nothing,  ///< the parameters unchanged
  /// Extension and bulge under pressure, fitted to the body's own inflation (to all its curves if it has none).
  sizes,
  /// Axial stiffness by wall class, ratios of bending, torsion and shear, joints and lateral coupling, fitted to all curves of
  /// the body.
  stiffness,
  /// Both, fitted together to all curves of the body, starting from its own sizes.
  both
};
std::string_view to_string(OwnPart part);

/// One trial: a body with a part of the parameters fitted to it.
struct CauseTrial {
  OwnPart part = OwnPart::nothing;
  io::RunStatus status = io::RunStatus::completed;  ///< of the fit; its best result is evaluated even if it did not converge
  std::string reason{};                             ///< why, if not completed
  std::vector<CurveComparison> comparisons{};       ///< of the body with these parameters
  bool all_computed = true;                         ///< whether every state that counts has an equilibrium
  double rms_error = 0.0;                           ///< of displacements and volumes that count, see ObservableError::error
  std::optional<double> rms_stiffness_error{};
};

/// The trials that show why the surrogate misses a body.
struct CauseReport {
  std::string body;
  /// Whether only states inside the range of validity count. False: no displacement and no volume of the body lies inside, so all
  /// its states count.
  bool inside = true;
  std::vector<CauseTrial> trials;  ///< in the order of OwnPart; fewer if stopped
  std::string verdict{};           ///< a sentence: which part closes the gap
};

struct CauseOptions {
  const std::atomic<bool>* stop = nullptr;
  std::function<void(OwnPart)> begin{};  ///< called before each trial; may be empty
};

/// Separates the possible causes of a miss: repeats the comparison with rest lengths, with stiffnesses, or with both fitted to
/// the body itself.
///
/// A part closes the gap if at most a quarter of the error remains, and is most of it if at most half remains. A gap that no part
/// closes lies in the form of the model: boxes, with beams between their centres, cannot follow the walls. The trials are fits to
/// the same curves that are used to evaluate them. They find causes; their parameters say nothing about other bodies.
///
/// Only states inside the range of validity of the unchanged parameters count, in the fits and in the evaluation, and the same
/// states in all trials. If no number in displacement or volume is inside, all states count.
/// @param comparisons with at least one number in displacement or volume of the body
CauseReport explain_miss(const std::vector<CurveComparison>& comparisons, const std::string& body,
                         const SurrogateParameters& parameters, const Responder& responder, const CauseOptions& options = {});

/// The reports of bodies as text lines. For more than one body, also the median errors of all of them together, by the part that
/// was fitted to each.
std::vector<std::string> cause_lines(const std::vector<CauseReport>& reports);

}  // namespace menger::voxel
