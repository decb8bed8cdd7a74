#include "io/run_status_words.h"

namespace menger::io {

const Words<RunStatus>& run_status_words() {
  static const Words<RunStatus> words = [] {
    Words<RunStatus> all;
    for (const RunStatus status : {RunStatus::completed, RunStatus::diverged, RunStatus::not_converged, RunStatus::limit_point,
                                   RunStatus::inverted_element, RunStatus::wall_contact, RunStatus::stopped})
      all.emplace_back(to_string(status), status);
    return all;
  }();
  return words;
}

}  // namespace menger::io
