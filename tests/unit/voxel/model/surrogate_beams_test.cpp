#include "voxel/model/surrogate_beams.h"

#include <gtest/gtest.h>

#include <cmath>

#include "voxel/engine/voxel_classes.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {
namespace {

SurrogateParameters solid(double modulus_Pa, double edge_m) {
  SurrogateParameters parameters;
  parameters.cell_edge_m = edge_m;
  parameters.axial_Pa.fill(modulus_Pa);
  parameters.bending_Pa.fill(modulus_Pa);
  parameters.torsion_Pa.fill(modulus_Pa);
  return parameters;
}

TEST(SurrogateBeams, EqualModuliAreTheSolidVoxel) {
  Physics physics;
  physics.materials[0] = physics.materials[1] = {.youngs_modulus_Pa = 3e4, .density_kg_m3 = 1000.0};
  const double edge = 0.01;
  const BeamCoefficients<double> expected = class_tables(physics, edge).beam.front();
  BeamCoefficients<double> beam = beam_coefficients(beam_section(solid(3e4, edge), 1, 3, false), edge);
  set_damping(beam, 1.0, 1e-3, 1e-3, false);
  // Products of at most six factors in another order: a few roundings.
  const auto near = [](double value, double wanted) { EXPECT_NEAR(value / wanted, 1.0, 1e-14); };
  near(beam.axial, expected.axial);
  near(beam.twist, expected.twist);
  near(beam.shear, expected.shear);
  near(beam.bend, expected.bend);
  near(beam.turn, expected.turn);
  near(beam.axial_root, expected.axial_root);
  near(beam.shear_root, expected.shear_root);
  near(beam.bend_root, expected.bend_root);
  near(beam.turn_root, expected.turn_root);
  near(beam.twist_root, expected.twist_root);
  near(beam.damping_lower, expected.damping_lower);
  near(beam.damping_upper, expected.damping_upper);
}

TEST(SurrogateBeams, HalvesStretchInSeries) {
  SurrogateParameters parameters = solid(1e4, 0.01);
  parameters.axial_Pa[2] = 4e4;
  parameters.bending_Pa[2] = 2e4;
  const SectionStiffness beam = beam_section(parameters, 0, 2, false);
  // Under a force F the halves of length l / 2 stretch by F l / (2 EA) each.
  const double force = 0.3, length = 0.01;
  const double stretch =
      force * length / 2 / section_of(parameters, 0).axial_N + force * length / 2 / section_of(parameters, 2).axial_N;
  EXPECT_NEAR(beam.axial_N * stretch / length, force, 1e-14);
  const double moment = 0.3;
  const double turn =
      moment * length / 2 / section_of(parameters, 0).bending_N_m2 + moment * length / 2 / section_of(parameters, 2).bending_N_m2;
  EXPECT_NEAR(beam.bending_N_m2 * turn / length, moment, 1e-14);
}

TEST(SurrogateBeams, JointsScaleTheSeries) {
  SurrogateParameters parameters = solid(1e4, 0.01);
  parameters.joint = {.axial = 2.0, .bending = 3.0, .torsion = 5.0};
  const SectionStiffness plain = beam_section(parameters, 1, 4, false);
  const SectionStiffness joint = beam_section(parameters, 1, 4, true);
  EXPECT_DOUBLE_EQ(joint.axial_N, 2.0 * plain.axial_N);
  EXPECT_DOUBLE_EQ(joint.bending_N_m2, 3.0 * plain.bending_N_m2);
  EXPECT_DOUBLE_EQ(joint.torsion_N_m2, 5.0 * plain.torsion_N_m2);
}

TEST(SurrogateBeams, AnEndLoadBendsThemLikeAnEulerBernoulliCantilever) {
  const SectionStiffness section = section_of(solid(1e4, 0.01), 0);
  const double length = 0.02, force = 1e-4;
  const BeamCoefficients<double> c = beam_coefficients(section, length);
  // Tip deflection F l^3 / (3 EI) and slope F l^2 / (2 EI) of a beam clamped at its lower end.
  BeamDeformation<double> e{};
  e.displacement.y = force * length * length * length / (3.0 * section.bending_N_m2);
  e.upper_angle.z = force * length * length / (2.0 * section.bending_N_m2);
  const BeamLoads<double> loads = beam_elastic_loads(c, e, length);
  EXPECT_NEAR(loads.upper_force.y, -force, 1e-14 * force * 100);
  EXPECT_NEAR(loads.upper_moment.z, 0.0, 1e-13 * force * length);
  EXPECT_NEAR(loads.lower_moment.z, force * length, 1e-13 * force * length);
}

}  // namespace
}  // namespace menger::voxel
