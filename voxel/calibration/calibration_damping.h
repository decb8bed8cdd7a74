#pragma once

#include "materials/laws/silicone_record.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// Returns the damping ratio of beams that gives a vibration the measured loss, at the frequency of the dynamic test.
///
/// Beams damp in proportion to their stiffness, c = zeta k / omega0 with omega0 = sqrt(EA / (L m)). A mode of angular frequency
/// omega then has the damping ratio zeta omega / (2 omega0). A loss tan(delta) gives it the damping ratio tan(delta) / 2. Hence
/// zeta = tan(delta) omega0 / omega. EA is that of a half beam with four walls; m is the mass of a cell inside a bar, with tube
/// section. At other frequencies the loss of the surrogate grows in proportion to the frequency, while that of silicone hardly
/// changes.
double bond_damping_ratio(const SurrogateParameters& parameters, const materials::LossData& loss);

}  // namespace menger::voxel
