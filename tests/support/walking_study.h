#pragma once

#include <string>

#include "evolution/study/study_file.h"
#include "io/text/whole_file.h"

namespace menger::tests {

/// The text of a study of bodies of silicone on finite elements that takes seconds: short walks at a fast drive.
/// @param evaluation, drive, more further keys of these tables, and further tables
inline std::string walking_study_text(const std::string& evaluation = "", const std::string& drive = "",
                                      const std::string& more = "") {
  return "preset = \"paper\"\ngenerations = 2\n[population]\nsurvivors = 3\nmutants = 3\n"
         "[evaluation]\nmodel = \"finite_elements\"\nstand = true\nconfirm = 0\n" +
         evaluation +
         "[body]\nlevels = [1]\ncastable = true\nwall_thickness_m = 0.002\n"
         "[time]\nduration_s = 0.05\n"
         "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 6000]\nfrequency_Hz = 40\n" +
         drive + "[material]\nsilicone = \"dragon_skin_10\"\n" + more;
}

/// Reads a study from its text. @param file is written
inline evolution::Study read_walking_study(const std::filesystem::path& file, const std::string& text = walking_study_text()) {
  io::write_whole(file, text);
  return evolution::read_study(file);
}

}  // namespace menger::tests
