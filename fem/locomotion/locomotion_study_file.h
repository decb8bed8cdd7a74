#pragma once

#include <filesystem>
#include <string_view>

#include "fem/locomotion/locomotion_study.h"

namespace menger::fem {

/// Reads a study of `menger locomote` and meshes its body. Tables: [design] (`file`, or `name`, `cells` and `digits`;
/// `cell_edge_m`, and the keys of read_hollow_body_options), [material] (read_locomotion_material; `damping_model` is "maxwell"
/// unless stated, "kelvin_voigt" and nothing else for implicit dynamics), [ground] (read_rigid_ground;
/// its height is that of the body's lowest point where none is given), [loads], either [drive] (read_surrogate_drive) or
/// [[pressure]], [[piston]] and [gas] (read_pneumatic_supply), [time], [dynamics] (`method`, "explicit" or "implicit", and
/// its own keys), [output], [sweep]; see LocomotionStudy for the other keys.
/// @throws io::InputError with file, key and value for anything else, and for a body that cannot be hollowed out or meshed
LocomotionStudy read_locomotion_study(const std::filesystem::path& file);

/// The same from text that stands for that of the file.
LocomotionStudy parse_locomotion_study(std::string_view text, const std::filesystem::path& file);

}  // namespace menger::fem
