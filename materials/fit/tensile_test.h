#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace menger::materials {

/// The record of a uniaxial tensile test.
struct TensileTest {
  std::string material;           ///< name of the material in the file, otherwise the name of the file
  std::string strain_source;      ///< how the strain was measured, in words; empty if the file does not state it
  std::vector<double> time_s;     ///< empty if the file has none
  std::vector<double> strain;     ///< engineering strain, a fraction
  std::vector<double> stress_Pa;  ///< nominal stress: force divided by reference area, tension positive
};

/// Reads a test from a CSV file in one of two formats.
///
/// The Soft Robotics Materials Database: separated by semicolons; some lines about the test; a line that starts with `Time (s)`;
/// then rows of time, true strain, true stress (MPa), engineering strain and engineering stress (MPa). The true strain and stress
/// are not read.
///
/// Two columns separated by commas, with their units in the header: `strain`, `strain_percent` or `stretch`, and `stress_Pa`,
/// `stress_kPa`, `stress_MPa` or `stress_psi` (nominal stress). `strain (%)` and `stress (kPa)` are also accepted.
/// @throws io::InputError with file, line and value for anything else, and for fewer than two rows
TensileTest read_tensile_test(const std::filesystem::path& file);

}  // namespace menger::materials
