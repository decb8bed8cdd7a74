// Paths to the end of equilibria: limit points, touching walls, and steps and moduli of unusual size.

#include <algorithm>
#include <cmath>
#include <string>

#include "meshes/hexahedra/hollow_polycube.h"
#include "tests/extremes/fem_rows.h"
#include "tests/verification/fem_hollow_cube.h"
#include "tests/verification/fem_pressure_vessels.h"

namespace menger::extremes {

namespace {

constexpr double radius_ratio = fem::outer_radius_m / fem::inner_radius_m;

/// The largest pressure of the sphere and the stretch there.
struct SphereLimit {
  double pressure_Pa = 0.0;
  double stretch = 1.0;
  SphereLimit() {
    for (double inner = 1.0; inner < 3.0; inner += 1e-5) {
      const double there_Pa = sphere_pressure_Pa(inner, radius_ratio);
      if (there_Pa > pressure_Pa) pressure_Pa = there_Pa, stretch = inner;
    }
  }
};

struct Sphere {
  fem::VesselCase vessel{fem::Vessel::sphere, materials::NeoHookean{shear_modulus_Pa}, nearly_incompressible* shear_modulus_Pa,
                         2};
  fem::Model model{fem::vessel_mesh(vessel.vessel, 1), 2, fem::vessel_body(vessel)};
};

void expect_limit(Outcome& outcome, const fem::PathReport& report, bool is_passed, double tolerance) {
  const SphereLimit exact;
  outcome.expect(report.limit_points.size() == 1, std::to_string(report.limit_points.size()) + " limit point");
  if (report.limit_points.empty()) return;
  outcome.expect(report.limit_points[0].passed == is_passed, is_passed ? "passed" : "not passed");
  outcome.expect_near("limit pressure Pa", report.limit_points[0].pressure_Pa, exact.pressure_Pa, tolerance);
}

void run_volume_control(Outcome& outcome) {
  constexpr double stretch = 2.0;
  Sphere sphere;
  const fem::PathReport report = follow(sphere.model, volume_drive(std::pow(stretch, 3)), fem::equal_steps(60));
  outcome.expect_status(report.status, io::RunStatus::completed, report.reason);
  expect_limit(outcome, report, true, 3e-4);
  outcome.expect_near("pressure at twice the radius Pa", report.points.back().pressures_Pa[0],
                      sphere_pressure_Pa(stretch, radius_ratio), 1e-3);
  expect_energy_error(outcome, report, 1e-3);
}

void run_pressure_control(Outcome& outcome) {
  Sphere sphere;
  const fem::PathReport report = follow(sphere.model, pressure_drive(20e3), fem::equal_steps(20));
  outcome.expect_status(report.status, io::RunStatus::limit_point);
  expect_limit(outcome, report, false, 1e-3);
  outcome.expect_between("reached Pa", report.points.back().pressures_Pa[0], 0.99 * SphereLimit().pressure_Pa,
                         SphereLimit().pressure_Pa);
  expect_energy_error(outcome, report, 0.02);
}

/// A body of two by two cells of 5 mm with one chamber of 8 x 8 x 3 mm. Its roof and floor touch first in the middle.
constexpr fem::Point under_roof{0.005, 0.005, 0.004}, on_floor{0.005, 0.005, 0.001};

fem::Model flat_body() {
  const meshes::Design design{.name = "pocket", .body = meshes::Polycube::from_digits(2, 2, 1, "1111"), .cell_edge_m = 0.005};
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 1e-3;
  const meshes::HexahedralMesh mesh = meshes::hollow_polycube(design, options).mesh;
  fem::Body body = fem::material_of_cube(fem::Formulation::three_field);
  body.point_supports = {
      {{0.0, 0.0, 0.0}, {true, true, true}}, {{0.01, 0.0, 0.0}, {false, true, true}}, {{0.0, 0.01, 0.0}, {false, false, true}}};
  fem::add_chambers(body, mesh);
  return {mesh, 2, body};
}

/// The first contact must be the same state for any path to it.
void run_vacuum(Outcome& outcome) {
  std::vector<fem::PathPoint> ends;
  for (const fem::PlenumDrive& drive : {pressure_drive(-30e3), volume_drive(0.01)}) {
    fem::Model model = flat_body();
    const fem::PathReport report = follow(model, drive, fem::equal_steps(20));
    outcome.expect_status(report.status, io::RunStatus::wall_contact, report.reason);
    ends.push_back(report.points.back());
    outcome.expect_between("gap m", ends.back().smallest_gap_m.value_or(-1.0), 0.0, 1e-5);
    const double approach_m = model.displacement_at(under_roof)[2] - model.displacement_at(on_floor)[2];
    outcome.expect_between("distance of roof and floor in the middle m", under_roof[2] - on_floor[2] + approach_m, 0.0, 1e-5);
    expect_energy_error(outcome, report, 0.02);
  }
  outcome.expect_between("pressure Pa", ends[0].pressures_Pa[0], -30e3, 0.0);
  outcome.expect_near("the same under control by volume Pa", ends[1].pressures_Pa[0], ends[0].pressures_Pa[0], 0.01);
  outcome.expect_near("volume m^3", ends[1].plenum_volumes_m3[0], ends[0].plenum_volumes_m3[0], 0.01);
}

/// Multiplies all moduli and pressures of the quarter of the hollow cube by a factor.
void run_moduli(Outcome& outcome) {
  const meshes::HexahedralMesh mesh = meshes::hollow_cube_quarter(fem::cube_edge_m, fem::cube_wall_m, 1);
  const auto inflated = [&](double factor) {
    fem::Body body = fem::quarter_of_cube();
    body.regions[0].law = materials::NeoHookean{factor * fem::cube_shear_modulus_Pa};
    body.regions[0].volume = materials::SimoTaylorVolume{factor * fem::cube_bulk_modulus_Pa};
    auto model = std::make_unique<fem::Model>(mesh, 2, body);
    const fem::PathReport report = follow(*model, pressure_drive(factor * 6e3), fem::equal_steps(8));
    outcome.expect_status(report.status, io::RunStatus::completed, report.reason);
    expect_energy_error(outcome, report, 0.01);
    return model;
  };
  const auto reference = inflated(1.0);
  const double top_m = reference->displacement_at(fem::cube_top)[2];
  for (const double factor : {1e-3, 1e3, 0x1p20}) {
    const auto scaled = inflated(factor);
    outcome.expect_at_most("displacements at moduli times " + shown(factor) + ", off by", scaled->distance_to(*reference) / top_m,
                           1e-9);
    outcome.expect_near("energy by factor J", scaled->strain_energy_J() / factor, reference->strain_energy_J(), 1e-9);
  }
}

/// Compares a hundred small steps with a single step.
void run_stride(Outcome& outcome) {
  const meshes::HexahedralMesh mesh = meshes::hollow_cube_quarter(fem::cube_edge_m, fem::cube_wall_m, 1);
  const auto end_of = [&](double step, fem::Model& model) {
    fem::PathOptions options;
    options.first_step = options.largest_step = step;
    options.desired_iterations = 1000;
    fem::PathReport report = follow(model, volume_drive(8.0), options);
    outcome.expect_status(report.status, io::RunStatus::completed, report.reason);
    outcome.note(std::to_string(report.points.size() - 1) + " steps, " + std::to_string(report.rejected_steps) + " cut");
    return report;
  };
  fem::Model fine(mesh, 1, fem::quarter_of_cube());
  const fem::PathReport small_steps = end_of(0.01, fine);
  fem::Model coarse(mesh, 1, fem::quarter_of_cube());
  const fem::PathReport strides = end_of(1.0, coarse);
  outcome.expect(strides.rejected_steps > 0, "the stride had to be cut");
  outcome.expect_near("pressure Pa", strides.points.back().pressures_Pa[0], small_steps.points.back().pressures_Pa[0], 1e-6);
  outcome.expect_at_most("displacements off by", coarse.distance_to(fine) / fine.displacement_at(fem::cube_top)[2], 1e-6);
  expect_energy_error(outcome, small_steps, 1e-3);
}

}  // namespace

std::vector<Row> fem_path_rows() {
  std::vector<Row> rows;
  rows.push_back({.name = "limit point under control by volume",
                  .done = "neo-Hookean sphere of radii 8 and 10 mm to twice its radius, 60 steps, Q2/P1",
                  .expected =
                      "completed, through the largest pressure of the closed form (3e-4: compression and the parabola through "
                      "three states) to its pressure at the end (1e-3)",
                  .run = run_volume_control});
  rows.push_back({.name = "limit point under control by pressure",
                  .done = "neo-Hookean sphere of radii 8 and 10 mm to 20 kPa in steps of 1 kPa, Q2/P1",
                  .expected = "limit_point, since no equilibrium lies beyond 13.75 kPa; the limit extrapolated to 1e-3",
                  .run = run_pressure_control});
  rows.push_back(
      {.name = "vacuum to first wall contact",
       .done = "flat chamber of 8 x 8 x 3 mm in walls of 1 mm, by pressure and by volume",
       .expected =
           "wall_contact with a gap below 10 um, roof on floor in the middle, at the same pressure and volume for both (1 %, "
           "a state within that gap)",
       .run = run_vacuum});
  rows.push_back({.name = "moduli over six decades",
                  .done = "hollow cube at 50 Pa, 50 kPa, 50 MPa and 2^20 times 50 kPa, pressures in proportion",
                  .expected = "the same displacements and, in proportion, energies, to 1e-9: rounding",
                  .run = run_moduli});
  rows.push_back({.name = "load step 100 times too large",
                  .done = "hollow cube to eight times its volume in steps of 1 %, and in one stride",
                  .expected = "completed after cuts, the same state to 1e-6, the tolerance of forces",
                  .run = run_stride});
  return rows;
}

}  // namespace menger::extremes
