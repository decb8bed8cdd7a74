#pragma once

#include <span>
#include <string>

#include "fem/pneumatics/pneumatic_supply.h"
#include "io/text/toml_document.h"

namespace menger::fem {

/// Reads the table [gas], which may be missing: exponent (1) and ambient_pressure_Pa (standard atmosphere), both > 0.
PneumaticGas read_pneumatic_gas(const io::TomlTable& study);

/// Reads what drives the plena of a body:
///
///     [[pressure]]                  # one table per plenum; a plenum without one stays at 0 Pa
///     plenum = "plenum 0"
///     supply = "schedule"           # the default: the plenum has the pressure of its schedule, see read_plenum_schedule
///                                   # "line": the schedule is that of a source behind a line; "piston": no schedule
///     piston = "cam"                # with supply = "piston"
///     resistance_Pa_s_per_m3 = 1e8  # >= 0, and volume_m3 (0): laminar at any flow; or length_m, diameter_m and
///                                   # viscosity_Pa_s (that of air): a round tube
///
///     [[piston]]                    # the members of Piston
///     [gas]                         # see above
///
/// @param study holds these tables @throws io::InputError with file, key and value for plena and pistons that are unknown or
/// named twice, values outside their ranges, strokes beyond the cylinder or that leave its air no room, pressures at or below
/// vacuum, and pistons that supply no plenum
PneumaticSupply read_pneumatic_supply(const io::TomlTable& study, std::span<const std::string> plenum_names);

}  // namespace menger::fem
