#pragma once

#include <cstddef>

#include "voxel/laws/beam.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// Stiffness of the cross-section of a beam.
struct SectionStiffness {
  double axial_N = 0.0;                 ///< EA, force per strain
  double bending_N_m2 = 0.0;            ///< EI, moment per curvature, the same about both axes
  double torsion_N_m2 = 0.0;            ///< GJ, moment per twist
  double shear_compliance_per_N = 0.0;  ///< 1 / (G A_s), shear angle per force, the same in both directions; 0: does not shear

  bool operator==(const SectionStiffness&) const = default;
};

/// Returns the section of a half beam of a wall class:
///
///   EA = axial_Pa L^2,  EI = bending_Pa L^4 / 12,  GJ = torsion_Pa L^4 / 12,  1 / (G A_s) = shear_compliance_per_Pa / L^2
///
/// @param wall_class position in wall_class_names
SectionStiffness section_of(const SurrogateParameters& parameters, std::size_t wall_class);

/// Returns the section of a beam that consists of two halves of equal length in series. Each stiffness is the harmonic mean
/// 2 a b / (a + b), the compliance is the mean. For bending this is exact under a constant moment, for shear under a constant
/// force.
SectionStiffness in_series(const SectionStiffness& a, const SectionStiffness& b);

/// Returns a section with the stiffnesses multiplied by the factors of a bonded joint. The shear compliance is unchanged, see
/// SurrogateParameters.
SectionStiffness joined(const SectionStiffness& section, const JointFactors& joint);

/// Returns the section of the beam between two voxels, from their wall classes along it.
/// @param crosses_joint whether the two voxels belong to different chambers
SectionStiffness beam_section(const SurrogateParameters& parameters, std::size_t lower_class, std::size_t upper_class,
                              bool crosses_joint);

/// Returns the coefficients of a Timoshenko beam of length l > 0 (m), exact at its ends. With Phi = 12 EI / (G A_s l^2):
///
///   axial = EA,  twist = GJ / l,  shear = 12 EI / (l^3 (1 + Phi)),  bend = 6 EI / (l^2 (1 + Phi)),
///   turn = 2 EI / (l (1 + Phi)),  turn_difference = Phi EI / (l (1 + Phi))
///
/// and their roots for the damping. The damping itself is not set; set_damping adds it. A section that does not shear has Phi = 0
/// and gives an Euler-Bernoulli beam. One with EA = E L^2, EI = GJ = E L^4 / 12 at l = L gives the solid voxel of Voxelyze.
///
/// Shear reduces the damping of transverse motion by sqrt(1 + Phi), like the root of its stiffness. It does not change the
/// damping of pure bending, in which no force shears the beam.
BeamCoefficients<double> beam_coefficients(const SectionStiffness& section, double length_m);

/// Sets the damping of a beam between two masses (kg), as a fraction of the critical damping of one mass on one beam.
/// @param bond_ratio zeta
/// @param equal_ends both ends get the mean of the two coefficients, which conserves momentum
void set_damping(BeamCoefficients<double>& beam, double bond_ratio, double lower_mass_kg, double upper_mass_kg, bool equal_ends);

}  // namespace menger::voxel
