#include "io/text/run_status.h"

namespace menger::io {

std::string_view to_string(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::diverged:
      return "diverged";
    case RunStatus::not_converged:
      return "not_converged";
    case RunStatus::limit_point:
      return "limit_point";
    case RunStatus::inverted_element:
      return "inverted_element";
    case RunStatus::wall_contact:
      return "wall_contact";
    case RunStatus::fell:
      return "fell";
    case RunStatus::stopped:
      return "stopped";
  }
  return "stopped";
}

}  // namespace menger::io
