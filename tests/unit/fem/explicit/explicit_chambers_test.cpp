#include "fem/explicit/explicit_chambers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/surfaces/chamber_volume.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

/// The reference positions, each moved by up to half a millimetre.
std::vector<double> moved_positions(const meshes::HexahedralMesh& mesh) {
  std::vector<double> positions = random_numbers(3 * mesh.points.size(), 0.5e-3, 5);
  for (std::size_t n = 0; n < positions.size(); ++n) positions[n] += mesh.points[n / 3][n % 3];
  return positions;
}

std::vector<double> nodal_forces(const ExplicitChambers& chambers, std::vector<double> positions, double pressure_Pa) {
  AlignedNumbers slots(chambers.number_count());
  const std::vector<double> pressures(chambers.plenum_count(), pressure_Pa);
  const std::size_t node_count = positions.size() / 3;
  positions.push_back(0.0);
  chambers.set_face_forces(positions, pressures, {0, chambers.batch_count()}, slots);
  chambers.set_cap_forces(positions, pressures, slots);
  std::vector<double> forces;
  for (std::size_t node = 0; node < node_count; ++node) {
    const std::array<double, 4> sum = chambers.slots().sum(slots.data(), node);
    forces.insert(forces.end(), sum.begin(), sum.begin() + 3);
    EXPECT_EQ(sum[3], 0.0);
  }
  return forces;
}

TEST(ExplicitChambers, VolumeIsThatOfTheImplicitFaces) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitChambers chambers(mesh);
  const std::vector<double> positions = moved_positions(mesh);
  double expected = 0.0;
  for (const meshes::BoundaryFace& face : mesh.faces) {
    if (face.label != mesh.chambers[0].labels[0]) continue;
    FaceNodes<4> nodes;
    constexpr std::array<std::size_t, 4> around{0, 1, 3, 2};
    for (std::size_t a = 0; a < 4; ++a)
      std::copy_n(positions.begin() + static_cast<long>(3 * face.corners[around[a]]), 3, nodes[a].begin());
    expected += chamber_volume<4>(nodes);
  }
  EXPECT_NEAR(chambers.volumes_m3(positions)[0], expected, 1e-13 * expected);
  EXPECT_NEAR(expected, std::pow(16e-3, 3), 0.1 * expected);
}

// A cube with a tube hole in its top: faces and the rim of a cap together.
meshes::HexahedralMesh cube_with_tube() {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  options.tubes = {{.cell = {0, 0, 0}, .side = meshes::Side::z_max, .edge_m = 4e-3}};
  return meshes::hollow_polycube(meshes::hollow_cube_design(20e-3), options).mesh;
}

TEST(ExplicitChambers, ForceIsPressureTimesTheGradientOfTheVolume) {
  for (const meshes::HexahedralMesh& mesh : {hollow_cube(), cube_with_tube()}) {
    const ExplicitChambers chambers(mesh);
    const std::vector<double> positions = moved_positions(mesh);
    constexpr double pressure = 3e3;
    const std::vector<double> forces = nodal_forces(chambers, positions, pressure);
    const std::vector<double> direction = random_numbers(positions.size(), 1.0, 6);
    constexpr double step = 1e-7;  // the volume is a cubic: the difference errs by (step / edge)^2, and by rounding over the step
    std::vector<double> ahead = positions;
    std::vector<double> behind = positions;
    double power = 0.0;
    for (std::size_t n = 0; n < positions.size(); ++n) {
      ahead[n] += step * direction[n];
      behind[n] -= step * direction[n];
      power += forces[n] * direction[n];
    }
    const double difference = (chambers.volumes_m3(ahead)[0] - chambers.volumes_m3(behind)[0]) / (2.0 * step);
    EXPECT_NEAR(power, pressure * difference, 1e-6 * std::abs(power));
  }
}

TEST(ExplicitChambers, InstructionSetsAgree) {
  const meshes::HexahedralMesh mesh = cube_with_tube();
  const std::vector<double> positions = moved_positions(mesh);
  const std::vector<double> best = nodal_forces(ExplicitChambers(mesh), positions, 1e3);
  double largest = 0.0;
  for (const double force : best) largest = std::max(largest, std::abs(force));
  for (const FacePressureKernels<double>& kernels : available_face_pressure_kernels<double>()) {
    const std::vector<double> forces = nodal_forces(ExplicitChambers(mesh, kernels), positions, 1e3);
    for (std::size_t n = 0; n < best.size(); ++n) EXPECT_NEAR(forces[n], best[n], 1e-13 * largest) << kernels.instruction_set;
  }
}

// Two bars of two cells, end to end, with a hole that joins their chambers to one plenum.
meshes::HexahedralMesh two_joined_bars() {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  options.level = 2;
  options.hole_edge_m = 2e-3;
  return meshes::hollow_polycube({"bar", meshes::Polycube::from_digits(2, 1, 1, "11"), 10e-3}, options).mesh;
}

// Faces placed by displacements, in either precision, have the forces and the change of volume of faces placed by positions.
template <class Number>
void expect_as_by_positions(const meshes::HexahedralMesh& mesh, double way, double tolerance) {
  const ExplicitChambers chambers(mesh);
  const std::vector<double> moved = moved_positions(mesh);
  std::vector<double> at_rest(moved.size());
  for (std::size_t n = 0; n < at_rest.size(); ++n) at_rest[n] = mesh.points[n / 3][n % 3];
  const std::vector<double> expected = nodal_forces(chambers, moved, 1e3);
  double change = 0.0;
  for (std::size_t c = 0; c < chambers.chamber_count(); ++c)
    change += chambers.volumes_m3(moved)[c] - chambers.volumes_m3(at_rest)[c];
  double largest = 0.0;
  for (const double force : expected) largest = std::max(largest, std::abs(force));
  for (const FacePressureKernels<Number>& kernels : available_face_pressure_kernels<Number>()) {
    const ChamberFaces<Number> faces(mesh, FaceValues::displacements, kernels);
    AlignedVector<Number> slots(faces.number_count() + 4, Number(0));
    std::vector<std::uint32_t> nodes;
    std::vector<std::uint32_t> own;
    faces.add_slots(0, nodes, own);
    const FourfoldSlots sums(nodes, own, mesh.points.size(), static_cast<std::uint32_t>(faces.number_count() / 4));
    AlignedVector<Number> displacements(moved.size() + 1, Number(0));
    for (std::size_t n = 0; n < moved.size(); ++n) displacements[n] = static_cast<Number>(moved[n] - at_rest[n] + way);
    std::vector<double> volumes(faces.batch_count());
    faces.compute({0, faces.batch_count()}, displacements.data(), std::vector(chambers.chamber_count(), 1e3), slots.data(),
                  volumes.data());
    for (std::size_t n = 0; n < expected.size(); ++n)
      EXPECT_NEAR(sums.sum(slots.data(), n / 3)[n % 3], expected[n], tolerance * largest) << kernels.instruction_set;
    EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), change, tolerance * std::abs(change));
  }
}

TEST(ExplicitChambers, PressureOnFacesPlacedByDisplacements) {
  for (const meshes::HexahedralMesh& mesh : {hollow_cube(), two_joined_bars()}) {
    expect_as_by_positions<double>(mesh, 0.1, 1e-11);
    // Steps of single precision at the common 1 mm are 1e-10 m, 1e-6 of the displacements.
    expect_as_by_positions<float>(mesh, 1e-3, 1e-5);
  }
}

TEST(ExplicitChambers, PlenaWithATubeAreNotClosed) {
  EXPECT_TRUE(has_closed_plena(hollow_cube()));
  EXPECT_TRUE(has_closed_plena(two_joined_bars()));
  EXPECT_FALSE(has_closed_plena(cube_with_tube()));
}

TEST(ExplicitChambers, PressureHasNoNetForceOnAClosedChamber) {
  for (const meshes::HexahedralMesh& mesh : {hollow_cube(), cube_with_tube()}) {
    const std::vector<double> forces = nodal_forces(ExplicitChambers(mesh), moved_positions(mesh), 1e3);
    double total = 0.0;
    Point net{};
    for (std::size_t n = 0; n < forces.size(); ++n) {
      net[n % 3] += forces[n];
      total += std::abs(forces[n]);
    }
    EXPECT_LT(norm(net), 1e-13 * total);
  }
}

}  // namespace
}  // namespace menger::fem
