#pragma once

#include <cstddef>

#include "voxel/laws/beam.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// Stiffness of a cross-section of a beam.
struct SectionStiffness {
  double axial_N = 0.0;                 ///< EA, force per strain
  double bending_N_m2 = 0.0;            ///< EI, moment per curvature, the same about both axes
  double torsion_N_m2 = 0.0;            ///< GJ, moment per twist
  double shear_compliance_per_N = 0.0;  ///< 1 / (G A_s), shear angle per force, the same in both directions; 0: does not shear

  bool operator==(const SectionStiffness&) const = default;
};

/// Section of a half beam of a class: EA = axial_Pa L^2, EI = bending_Pa L^4 / 12, GJ = torsion_Pa L^4 / 12, 1 /
/// (G A_s) = shear_compliance_per_Pa / L^2. @param wall_class position in wall_class_names
SectionStiffness section_of(const SurrogateParameters& parameters, std::size_t wall_class);

/// Section of a beam of two halves of equal length one behind the other: the harmonic mean 2 a b / (a + b) of each stiffness and
/// the mean of the compliances. For bending that is exact under a constant moment, for shear under a constant force.
SectionStiffness in_series(const SectionStiffness& a, const SectionStiffness& b);

/// A section with the factors of a bonded joint. They leave the shear compliance as it is, see SurrogateParameters.
SectionStiffness joined(const SectionStiffness& section, const JointFactors& joint);

/// Section of the beam between two voxels whose classes along it are given, `crosses_joint` where they are of different chambers.
SectionStiffness beam_section(const SurrogateParameters& parameters, std::size_t lower_class, std::size_t upper_class,
                              bool crosses_joint);

/// Coefficients of a Timoshenko beam of a length l > 0 (m), exact at its ends: with Phi = 12 EI / (G A_s l^2), axial = EA, twist
/// = GJ / l, shear = 12 EI / (l^3 (1 + Phi)), bend = 6 EI / (l^2 (1 + Phi)), turn = 2 EI / (l (1 + Phi)), turn_difference = Phi
/// EI / (l (1 + Phi)), and their roots for the damping; without damping, which set_damping adds. A section that does not shear
/// has Phi = 0 and is Euler-Bernoulli's; one of E L^2, E L^4 / 12, E L^4 / 12 at l = L is the solid voxel of Voxelyze.
///
/// Shear softens the damping of transverse motion by sqrt(1 + Phi), as the root of its stiffness, and leaves that of pure
/// bending, in which no force shears the beam.
BeamCoefficients<double> beam_coefficients(const SectionStiffness& section, double length_m);

/// Sets the damping of a beam between two masses (kg), as a share of the critical damping of one mass on one beam. @param
/// bond_ratio zeta @param equal_ends both ends get the mean of the two, which conserves momentum
void set_damping(BeamCoefficients<double>& beam, double bond_ratio, double lower_mass_kg, double upper_mass_kg, bool equal_ends);

}  // namespace menger::voxel
