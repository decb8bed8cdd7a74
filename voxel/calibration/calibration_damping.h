#pragma once

#include "materials/laws/silicone_record.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// The damping ratio of beams with which a vibration at the frequency of a dynamic test loses what the test says.
///
/// Beams damp in proportion to their stiffness, c = zeta k / omega0 with omega0 = sqrt(EA / (L m)), so that a mode of angular
/// frequency omega has the ratio zeta omega / (2 omega0); a loss tan(delta) makes it tan(delta) / 2. Hence zeta = tan(delta)
/// omega0 / omega. EA is that of a half beam with four walls, m the mass of a cell inside a bar, of tube section. At other
/// frequencies the surrogate's loss grows in proportion to them, while that of silicone hardly changes.
double bond_damping_ratio(const SurrogateParameters& parameters, const materials::LossData& loss);

}  // namespace menger::voxel
