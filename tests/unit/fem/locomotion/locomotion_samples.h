#pragma once

#include <filesystem>
#include <string>

#include "fem/locomotion/locomotion_study_file.h"
#include "io/text/whole_file.h"

namespace menger::fem {

/// The lines of studies of small bodies, to be put together.
namespace locomotion_samples {

/// A hollow cube of 20 mm with walls of 4 mm.
inline const std::string cube =
    "[design]\nname = \"cube\"\ncells = [1, 1, 1]\ndigits = \"1\"\ncell_edge_m = 0.02\nwall_thickness_m = 0.004\n";
/// An L of three cells, which no mirror turns into itself along x.
inline const std::string hook =
    "[design]\nname = \"hook\"\ncells = [2, 1, 2]\ndigits = \"1110\"\ncell_edge_m = 0.01\nwall_thickness_m = 0.002\n";
inline const std::string rubber =
    "[material]\nlaw = {name = \"neo_hookean\", shear_modulus_Pa = 5e4}\ndensity_kg_per_m3 = 1070\nbulk_modulus_ratio = 20\n"
    "loss_factor = 0.1\nloss_frequency_Hz = 30\n";
/// Its viscosity calms a body in a tenth of a second, which a branch does not.
inline const std::string silicone = rubber + "damping_model = \"kelvin_voigt\"\n";
inline const std::string ground = "[ground]\nstatic_friction = 1.0\nkinetic_friction = 0.5\n";
inline const std::string drive = "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 4000]\nfrequency_Hz = 20\n";
inline const std::string time = "[time]\nduration_s = 0.1\nrecord_interval_s = 0.01\n";
inline const std::string no_pictures = "[output]\npictures = false\nrecords_per_frame = 4\n";

inline const std::string cube_study = cube + silicone + ground + drive + time + no_pictures;
inline const std::string short_time = "[time]\nduration_s = 0.04\nrecord_interval_s = 0.004\n";
inline const std::string hook_study = hook + silicone + ground + drive + short_time + no_pictures;

}  // namespace locomotion_samples

/// A study from text, as if it stood in study.toml.
inline LocomotionStudy sample_study(const std::string& text) { return parse_locomotion_study(text, "study.toml"); }

}  // namespace menger::fem
