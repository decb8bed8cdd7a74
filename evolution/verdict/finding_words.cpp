#include "evolution/verdict/finding_words.h"

#include "io/text/run_status_words.h"

namespace menger::evolution {

std::string with_reason(io::RunStatus status, const std::string& reason) {
  return std::string(io::to_string(status)) + (reason.empty() ? "" : ", " + reason);
}

std::string sentence_of(std::string line) {
  if (!line.empty() && line.front() >= 'a' && line.front() <= 'z') line.front() = static_cast<char>(line.front() - 'a' + 'A');
  return line + ".";
}

Finding missing(const std::string& what, const std::string& command) {
  return {Tone::missing, what + " was not computed.", "menger " + command};
}

Tone worse_of(Tone a, Tone b) {
  if (a == Tone::missing || b == Tone::missing) return a == Tone::missing ? b : a;
  return std::max(a, b);
}

}  // namespace menger::evolution
