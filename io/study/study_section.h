#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace menger::io {

/// A table of a TOML text while it is made: in TOML the values of a table come before the tables in it, in a description they
/// come in any order.
struct StudySection {
  std::string header;                    ///< "[ground]"; empty for the top of the file
  std::string lines;                     ///< whole lines
  bool is_kept = false;                  ///< whether the header says something without lines, too
  std::vector<StudySection> sections{};  ///< the tables in it

  /// The text. @param between tables
  [[nodiscard]] std::string text(std::string_view between = {}) const;
};

}  // namespace menger::io
