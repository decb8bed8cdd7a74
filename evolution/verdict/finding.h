#pragma once

#include <string>
#include <vector>

namespace menger::evolution {

/// What a finding means for the use of the results.
enum class Tone {
  note,     ///< to be known, without a judgement
  good,     ///< can be relied on
  caution,  ///< to be used with care
  bad,      ///< not to be relied on
  missing   ///< was not computed
};

/// Returns the word for a tone, as the page's classes have it: "good", "caution", ...
const char* to_string(Tone tone);

/// A sentence of the verdict.
struct Finding {
  Tone tone = Tone::missing;
  std::string text{};
  std::string
      source;  ///< where its numbers come from: files relative to the folder of the report, or a command that computes them
};

/// The verdict: what the results say, in words.
struct Verdict {
  std::string headline{};               ///< one or two sentences
  std::vector<std::string> came_out{};  ///< what the loop said of these results; if there are some, they stand for the headline
  std::vector<std::string> forecast{};  ///< what the loop said before its stages: law, expected error, warnings
  Tone tone = Tone::missing;
  std::vector<Finding> findings{};
};

}  // namespace menger::evolution
