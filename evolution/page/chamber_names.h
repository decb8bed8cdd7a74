#pragma once

#include <string>
#include <vector>

#include "evolution/outputs/command_outputs.h"

namespace menger::evolution {

/// The chambers of a body as people know them: by the material of their cells, not by the numbers that files give them.
class ChamberNames {
 public:
  /// @param output of a command, whose parameters state the body
  explicit ChamberNames(const CommandOutput& output);

  /// Returns the material of a plenum, "plenum 0" or "plenum_0" in files; 0 if it is not known.
  [[nodiscard]] int material_of(const std::string& plenum) const;

  /// Returns the name of a plenum for people: "chamber of material 1", or "chamber 2 of material 1" where there are several;
  /// "plenum 0" if its material is not known.
  [[nodiscard]] std::string name_of(const std::string& plenum) const;

  /// Returns all chambers with their names in files: "chamber of material 1 (plenum 0 in files), ..."; empty if not known.
  [[nodiscard]] std::string all() const;

 private:
  std::vector<int> materials_;  ///< by the number of the plenum
};

}  // namespace menger::evolution
