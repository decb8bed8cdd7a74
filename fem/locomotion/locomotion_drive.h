#pragma once

#include <vector>

#include "fem/pneumatics/pressure_schedule.h"
#include "io/text/toml_document.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Reads the pressure drive of the surrogate's scenes, so that both models get the same pressure in the same chamber at the same
/// time: with the mean m and the amplitude a of `pressure_Pa = [lowest, highest]`, r = min(1, t / ramp_s) and the phase phi,
///
///   p(t) = r (m + a sin(2 pi (t / T + phi))).
///
/// Keys: `mode` ("in_phase", "antiphase", "wave", "hold": p = r highest, "none": p = 0), `period_s` or `frequency_Hz`, `ramp_s`
/// (one period), `material_phase` (antiphase, [0, 0.5]), `wave_axis` ("y"), `wave_periods_per_body` (-1) and `wave_over_gaps`
/// (false); all as in [actuation] there.
/// @param mesh of the design hollowed out so @return one schedule per plenum
/// @throws io::InputError with file, key and value; for a plenum whose cells differ in phase, too, which its air cannot realise
std::vector<PlenumSchedule> read_surrogate_drive(const io::TomlTable& table, const meshes::Design& design,
                                                 const meshes::HollowBodyOptions& hollow, const meshes::HexahedralMesh& mesh);

}  // namespace menger::fem
