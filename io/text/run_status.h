#pragma once

#include <string_view>

namespace menger::io {

/// How a run ended. All result files of menger use these words.
enum class RunStatus {
  completed,         ///< reached its end
  diverged,          ///< left the range in which the model is valid
  not_converged,     ///< an iteration did not reach its tolerance
  limit_point,       ///< no equilibrium beyond this load: a limit point
  inverted_element,  ///< a volume ratio became non-positive
  wall_contact,      ///< two chamber walls touched
  fell,              ///< a robot fell over: it reached the end, but did not walk there
  stopped            ///< the user or a given budget ended it
};

/// Returns the word for a status, as written to files: "completed", "diverged", ...
std::string_view to_string(RunStatus status);

}  // namespace menger::io
