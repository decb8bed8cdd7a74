#include "io/study/study_section.h"

namespace menger::io {

std::string StudySection::text(std::string_view between) const {
  std::string all;
  if (!lines.empty() || is_kept) all = (header.empty() ? header : header + "\n") + lines;
  for (const StudySection& section : sections) {
    const std::string part = section.text(between);
    if (!all.empty() && !part.empty()) all += between;
    all += part;
  }
  return all;
}

}  // namespace menger::io
