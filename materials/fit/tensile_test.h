#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace menger::materials {

/// A uniaxial tensile test as it was recorded.
struct TensileTest {
  std::string material;           ///< as the file names it, otherwise the name of the file
  std::string strain_source;      ///< how the strain was measured, in words; empty if the file does not say
  std::vector<double> time_s;     ///< empty if the file has none
  std::vector<double> strain;     ///< engineering strain, a fraction
  std::vector<double> stress_Pa;  ///< nominal stress, force by reference area, tension positive
};

/// Reads a test from CSV, in either of two formats.
///
/// The Soft Robotics Materials Database: separated by semicolons, some lines about the test, a line that starts with `Time (s)`,
/// then rows of time, true strain, true stress (MPa), engineering strain and engineering stress (MPa), of which the true ones are
/// not read.
///
/// Two columns separated by commas with their units in the header: `strain`, `strain_percent` or `stretch`, and `stress_Pa`,
/// `stress_kPa`, `stress_MPa` or `stress_psi` (nominal); `strain (%)` and `stress (kPa)` will do as well.
/// @throws io::InputError with file, line and value for anything else, and for fewer than two rows
TensileTest read_tensile_test(const std::filesystem::path& file);

}  // namespace menger::materials
