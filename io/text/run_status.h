#pragma once

#include <string_view>

namespace menger::io {

/// How a run ended, in the words that every result file of menger uses.
enum class RunStatus {
  completed,         ///< reached its end
  diverged,          ///< left the range in which the model means anything
  not_converged,     ///< an iteration did not reach its tolerance
  limit_point,       ///< no equilibrium beyond this load
  inverted_element,  ///< a volume ratio became non-positive
  wall_contact,      ///< two chamber walls touched
  stopped            ///< the user or a stated budget ended it
};

/// The word for a status, as written to files: "completed", "diverged", ...
std::string_view to_string(RunStatus status);

}  // namespace menger::io
