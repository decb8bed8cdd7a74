#include "voxel/model/surrogate_beams.h"

#include <cmath>

namespace menger::voxel {

namespace {

double harmonic_mean(double a, double b) { return 2.0 * a * b / (a + b); }

}  // namespace

SectionStiffness section_of(const SurrogateParameters& parameters, std::size_t wall_class) {
  const double edge2 = parameters.voxel_edge_m() * parameters.voxel_edge_m();
  return {.axial_N = parameters.axial_Pa.at(wall_class) * edge2,
          .bending_N_m2 = parameters.bending_Pa.at(wall_class) * edge2 * edge2 / 12.0,
          .torsion_N_m2 = parameters.torsion_Pa.at(wall_class) * edge2 * edge2 / 12.0,
          .shear_compliance_per_N = parameters.shear_compliance_per_Pa.at(wall_class) / edge2};
}

SectionStiffness in_series(const SectionStiffness& a, const SectionStiffness& b) {
  return {.axial_N = harmonic_mean(a.axial_N, b.axial_N),
          .bending_N_m2 = harmonic_mean(a.bending_N_m2, b.bending_N_m2),
          .torsion_N_m2 = harmonic_mean(a.torsion_N_m2, b.torsion_N_m2),
          .shear_compliance_per_N = 0.5 * (a.shear_compliance_per_N + b.shear_compliance_per_N)};
}

SectionStiffness joined(const SectionStiffness& section, const JointFactors& joint) {
  return {.axial_N = joint.axial * section.axial_N,
          .bending_N_m2 = joint.bending * section.bending_N_m2,
          .torsion_N_m2 = joint.torsion * section.torsion_N_m2,
          .shear_compliance_per_N = section.shear_compliance_per_N};
}

SectionStiffness beam_section(const SurrogateParameters& parameters, std::size_t lower_class, std::size_t upper_class,
                              bool crosses_joint) {
  const SectionStiffness section = in_series(section_of(parameters, lower_class), section_of(parameters, upper_class));
  return crosses_joint ? joined(section, parameters.joint) : section;
}

BeamCoefficients<double> beam_coefficients(const SectionStiffness& section, double length_m) {
  const double length2 = length_m * length_m;
  const double phi = 12.0 * section.bending_N_m2 * section.shear_compliance_per_N / length2;
  const double softening = 1.0 + phi;
  BeamCoefficients<double> c{};
  c.axial = section.axial_N;
  c.twist = section.torsion_N_m2 / length_m;
  c.shear = 12.0 * section.bending_N_m2 / (length2 * length_m) / softening;
  c.bend = 6.0 * section.bending_N_m2 / length2 / softening;
  c.turn = 2.0 * section.bending_N_m2 / length_m / softening;
  c.turn_difference = 0.5 * phi * c.turn;
  // The roots use the moment of inertia of a solid voxel, m l^2 / 6. Those of the ends would make the damping of bending
  // indefinite.
  c.axial_root = std::sqrt(c.axial / length_m);
  c.shear_root = std::sqrt(c.shear);
  c.bend_root = std::sqrt(c.bend * length_m / 2.0);
  c.turn_root = std::sqrt(c.turn * length2 / 6.0);
  c.twist_root = std::sqrt(c.twist * length2 / 6.0);
  // Opposite rotations of the two ends are damped by turn_root + 2 turn_difference_root, which is the root without shear.
  c.turn_difference_root = 0.5 * (std::sqrt(softening) - 1.0) * c.turn_root;
  return c;
}

void set_damping(BeamCoefficients<double>& beam, double bond_ratio, double lower_mass_kg, double upper_mass_kg, bool equal_ends) {
  beam.damping_lower = bond_ratio * std::sqrt(lower_mass_kg);
  beam.damping_upper = bond_ratio * std::sqrt(upper_mass_kg);
  if (equal_ends) beam.damping_lower = beam.damping_upper = 0.5 * (beam.damping_lower + beam.damping_upper);
}

}  // namespace menger::voxel
