#include "io/text/run_status.h"

#include <algorithm>
#include <string>
#include <utility>

#include "io/text/input_error.h"
#include "io/text/run_status_words.h"

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

const Words<RunStatus>& run_status_words() {
  static const Words<RunStatus> words = [] {
    Words<RunStatus> all;
    for (const RunStatus status : {RunStatus::completed, RunStatus::diverged, RunStatus::not_converged, RunStatus::limit_point,
                                   RunStatus::inverted_element, RunStatus::wall_contact, RunStatus::fell, RunStatus::stopped})
      all.emplace_back(to_string(status), status);
    return all;
  }();
  return words;
}

RunStatus run_status_of(int number) {
  const Words<RunStatus>& words = run_status_words();
  const auto found = std::ranges::find_if(words, [&](const auto& known) { return static_cast<int>(known.second) == number; });
  if (found == words.end()) throw InputError(std::to_string(number) + " is not the number of a status of a run");
  return found->second;
}

RunStatus run_status_of(std::string_view word) {
  const Words<RunStatus>& words = run_status_words();
  const auto found = std::ranges::find(words, word, &std::pair<std::string_view, RunStatus>::first);
  if (found == words.end()) throw InputError("\"" + std::string(word) + "\" is not a status of a run");
  return found->second;
}

}  // namespace menger::io
