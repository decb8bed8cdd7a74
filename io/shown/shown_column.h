#pragma once

#include <string>

namespace menger::io {

/// A column of a table as people see it in figures.
struct ShownColumn {
  std::string name;      ///< in the file
  std::string quantity;  ///< "plenum 0 pressure"
  std::string unit;      ///< "kPa"; empty if it has none
  double factor = 1.0;   ///< from the unit of the file to this one

  /// "plenum 0 pressure (kPa)"
  [[nodiscard]] std::string title() const;
};

/// Returns how a column is shown, by the unit at the end of its name: pressures in kPa, lengths in mm, angles in degrees, changes
/// of volume in per cent.
ShownColumn shown_column(const std::string& name);

/// Returns the name of a displacement in a sentence: "the extent along y" for extent_y_m, "the height of the top" for top_m; for
/// others the quantity of shown_column.
std::string displacement_words(const std::string& name);

}  // namespace menger::io
