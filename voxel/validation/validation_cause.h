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

/// What a body is given of its own, in place of what the parameters say.
enum class OwnPart {
  nothing,    ///< the parameters as they are
  sizes,      ///< extension and bulge under pressure, fitted to the body's own inflation (to all its curves if it has none)
  stiffness,  ///< axial stiffness by wall class, ratios of bending, torsion and shear, joints and lateral coupling, fitted to all
              ///< curves of the body
  both        ///< fitted together to all curves of the body, beginning with its own sizes
};
std::string_view to_string(OwnPart part);

/// A body with something of its own.
struct CauseTrial {
  OwnPart part = OwnPart::nothing;
  io::RunStatus status = io::RunStatus::completed;  ///< of the fit, whose best is judged whether or not it converged
  std::string reason{};                             ///< why, if not completed
  std::vector<CurveComparison> comparisons{};       ///< of the body with this part of its own
  bool all_answered = true;                         ///< every state that counts has an equilibrium
  double rms_error = 0.0;                           ///< of the displacements and volumes that count, see ObservableError::error
  std::optional<double> rms_stiffness_error{};
};

/// Why the surrogate misses a body.
struct CauseReport {
  std::string body;
  bool inside = true;              ///< only states inside the range of validity count; false: there are none, and all count
  std::vector<CauseTrial> trials;  ///< in the order of OwnPart; fewer if stopped
  std::string verdict{};           ///< which of them closes the gap, in a sentence
};

struct CauseOptions {
  const std::atomic<bool>* stop = nullptr;
  std::function<void(OwnPart)> begin{};  ///< called before each trial; may be empty
};

/// The experiment that separates the causes of a miss: what if the body had rest lengths of its own, or stiffnesses, or both?
///
/// A part closes the gap if it leaves at most a quarter of the error, and is most of it if it leaves at most half. What no part
/// closes lies in the shape of the model: boxes and beams between their centres that cannot follow the walls. The trials are fits
/// to the very curves they are judged by, and so say nothing about other bodies: they are for finding causes, not parameters.
///
/// Only states inside the range of validity of the parameters as they are count, in the fits as in the judgement and the same in
/// all trials; where no number in displacement and volume is inside, all states do.
/// @param comparisons with at least one number in displacement or volume of the body
CauseReport explain_miss(const std::vector<CurveComparison>& comparisons, const std::string& body,
                         const SurrogateParameters& parameters, const Responder& responder, const CauseOptions& options = {});

/// The reports of bodies as lines for people; of more than one also the median errors of all of them together, by what each is
/// given of its own.
std::vector<std::string> cause_lines(const std::vector<CauseReport>& reports);

}  // namespace menger::voxel
