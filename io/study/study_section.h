#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace menger::io {

/// A table of a TOML text under construction. TOML wants the values of a table before the tables in it; a description may name
/// them in any order.
struct StudySection {
  std::string header;                    ///< "[ground]"; empty for the top of the file
  std::string lines;                     ///< whole lines
  bool is_kept = false;                  ///< whether the header is written even if there are no lines
  std::vector<StudySection> sections{};  ///< the tables in it

  /// Returns the text. @param between text to put between two tables
  [[nodiscard]] std::string text(std::string_view between = {}) const;
};

}  // namespace menger::io
