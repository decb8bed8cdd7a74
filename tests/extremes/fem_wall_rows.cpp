// Walls from thin to nearly solid, and elements from cubes to thin plates.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "meshes/hexahedra/grid_mesh.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/extremes/fem_rows.h"

namespace menger::extremes {

namespace {

/// Returns the deflection of the middle of a clamped square plate under pressure p: 0.00126532 p a^4 / D (Timoshenko), with D = E
/// t^3 / (12 (1 - nu^2)), which is mu t^3 / 3 for an incompressible wall.
double clamped_plate_m(double pressure_Pa, double span_m, double thickness_m) {
  return 0.00126532 * pressure_Pa * std::pow(span_m, 4) / (shear_modulus_Pa * std::pow(thickness_m, 3) / 3.0);
}

/// A wall thickness divided by the edge of the cube, and the expected increase of the chamber volume.
struct Wall {
  double by_edge;
  /// dV/dp mu / edge^3 in the linear range, from graded Q2/P1 meshes. There are six elements across the smaller of the wall and
  /// half the chamber; with four the value changes by at most 0.13 %.
  double swelling;
  /// The result of the mesh of the programs, with one Q2/P1 element through the wall, divided by `swelling`.
  double one_element;
};

constexpr std::array walls{Wall{0.02, 755.5, 1.004},   Wall{0.05, 40.76, 1.072}, Wall{0.1, 4.180, 1.135},
                           Wall{0.2, 0.3967, 1.144},   Wall{0.3, 0.07203, 1.02}, Wall{0.4, 0.00791, 0.838},
                           Wall{0.45, 0.000975, 0.602}};

/// Returns edges along a span. Each is 1.5 times as long as the one before. The first one is at most `first_m`, shortened to make
/// them fit.
std::vector<double> growing_edges(double span_m, double first_m) {
  std::vector<double> edges_m;
  double sum_m = 0.0;
  for (double edge_m = first_m; sum_m < span_m * (1.0 - 1e-9); edge_m *= 1.5) {
    edges_m.push_back(edge_m);
    sum_m += edge_m;
  }
  for (double& edge_m : edges_m) edge_m *= span_m / sum_m;
  return edges_m;
}

/// Returns one octant of the hollow cube about the origin. Elements grow away from the edges of the chamber, where stresses are
/// singular. @param fineness smallest elements across the smaller of the wall and half the chamber
meshes::HexahedralMesh octant(double wall_m, int fineness) {
  const double half_m = 0.5 * HollowCube::edge_m - wall_m;
  const double first_m = std::min(wall_m, half_m) / fineness;
  meshes::GridLines lines;
  double place_m = half_m;
  for (const double edge_m : growing_edges(half_m, first_m)) lines.insert(lines.begin(), place_m -= edge_m);
  lines.front() = 0.0;
  const std::size_t across_chamber = lines.size();
  lines.push_back(half_m);
  for (const double edge_m : growing_edges(wall_m, first_m)) lines.push_back(lines.back() + edge_m);
  meshes::MeshGrid grid{.lines = {lines, lines, lines}, .contents = {}};
  constexpr std::size_t outer = 3, chamber = 4;
  const std::size_t size = lines.size() - 1;
  for (std::size_t z = 0; z < size; ++z) {
    for (std::size_t y = 0; y < size; ++y) {
      for (std::size_t x = 0; x < size; ++x) {
        const bool is_air = std::max({x, y, z}) < across_chamber;
        grid.contents.push_back(is_air ? meshes::GridContent::air(chamber) : meshes::GridContent::solid(0));
      }
    }
  }
  meshes::HexahedralMesh mesh;
  mesh.region_names = {"wall"};
  mesh.label_names = {"symmetry x", "symmetry y", "symmetry z", "outer", "chamber 0"};
  meshes::fill_from_grid(mesh, grid, {0, outer, 1, outer, 2, outer});
  mesh.plenum_names = {"plenum 0"};
  mesh.chambers = {{"chamber 0", {chamber}, {}, 0}};
  return mesh;
}

/// Returns a pressure that bulges a thin wall by a hundredth of its thickness, or strains a thick one by 1e-4.
double small_pressure_Pa(double wall_m) {
  return std::min(1e-4 * shear_modulus_Pa, 1e-2 * wall_m / clamped_plate_m(1.0, HollowCube::edge_m, wall_m));
}

/// Returns dV/dp mu / edge^3 of the modelled part; nan if there is no equilibrium.
double swelling(fem::Model& model, double pressure_Pa) {
  fem::PathOptions options;
  options.first_step = options.largest_step = 1.0;
  const fem::PathReport report = follow(model, pressure_drive(pressure_Pa), options);
  if (report.status != io::RunStatus::completed) return std::nan("");
  const double grown_m3 = report.points.back().plenum_volumes_m3[0] - report.points.front().plenum_volumes_m3[0];
  return grown_m3 / pressure_Pa * shear_modulus_Pa / std::pow(HollowCube::edge_m, 3);
}

/// Checks the computed value against two bounds of energy. For the lower bound, an isochoric radial motion of a shell that
/// contains the cube costs at least the energy. For the upper bound, the stress of a shell in the cube around a sphere that
/// contains the chamber is in equilibrium.
void expect_within_shells(Outcome& outcome, const Wall& wall, double computed) {
  const double inscribed = 0.5 - wall.by_edge;
  const double circumscribed = std::sqrt(3.0) * inscribed;
  const double least = std::numbers::pi / (std::pow(inscribed, -3) - std::pow(0.5 * std::sqrt(3.0), -3));
  const double most = circumscribed < 0.5 ? std::numbers::pi / (std::pow(circumscribed, -3) - 8.0) : HUGE_VAL;
  // Compression of the wall, kappa = 1e4 mu, widens the bounds of an incompressible wall.
  constexpr double compression = 1e-3;
  outcome.expect_between("the same within bounds of energy", computed, least * (1.0 - compression), most * (1.0 + compression));
}

/// Compares the middle of a face with the middle of its edge.
void expect_bulge_of_plate(Outcome& outcome, const fem::Model& model, double wall_m, double pressure_Pa) {
  constexpr double edge_m = HollowCube::edge_m;
  constexpr double half_m = 0.5 * edge_m;
  const double bulge_m = model.displacement_at({half_m, half_m, edge_m})[2] - model.displacement_at({half_m, 0.0, edge_m})[2];
  outcome.expect_at_most("bulge by that of a plate over the middle planes",
                         bulge_m / clamped_plate_m(pressure_Pa, edge_m - wall_m, wall_m), 1.0);
  outcome.expect_between("bulge by that of a plate over the chamber",
                         bulge_m / clamped_plate_m(pressure_Pa, edge_m - 2.0 * wall_m, wall_m), 1.0, 1.1);
}

void run_wall(Outcome& outcome, const Wall& wall) {
  const double wall_m = wall.by_edge * HollowCube::edge_m;
  const double pressure_Pa = small_pressure_Pa(wall_m);
  const meshes::HexahedralMesh mesh = octant(wall_m, 2);
  fem::Body body = fem::body_of(materials::NeoHookean{shear_modulus_Pa},
                                materials::SimoTaylorVolume{nearly_incompressible * shear_modulus_Pa});
  fem::hold_symmetry(body, mesh);
  fem::add_chambers(body, mesh);
  fem::Model graded(mesh, 2, body);
  const double computed = 8.0 * swelling(graded, pressure_Pa);
  outcome.expect_near("dV/dp mu/edge^3", computed, wall.swelling, 0.01);
  expect_within_shells(outcome, wall, computed);
  const HollowCube cube(wall.by_edge);
  fem::Model coarse(cube.mesh, 2, cube.body);
  outcome.expect_between("one element through the wall, by that", swelling(coarse, pressure_Pa) / wall.swelling,
                         wall.one_element - 0.02, wall.one_element + 0.02);
  if (wall.by_edge < 0.03) expect_bulge_of_plate(outcome, coarse, wall_m, pressure_Pa);
}

/// Inflates the chamber to 1.5 times its volume and checks the energy balance. The pressure must increase with the wall
/// thickness.
void run_inflated_walls(Outcome& outcome) {
  double last_Pa = 0.0;
  for (const double wall_by_edge : {0.02, 0.1, 0.2, 0.3, 0.45}) {
    const HollowCube cube(wall_by_edge);
    fem::Model model(cube.mesh, 1, cube.body);
    fem::PathOptions options;
    options.first_step = options.largest_step = 0.1;
    const fem::PathReport report = follow(model, volume_drive(1.5), options);
    outcome.expect_status(report.status, io::RunStatus::completed, report.reason);
    const double pressure_Pa = report.points.back().pressures_Pa[0];
    outcome.expect(pressure_Pa > last_Pa, "t/edge " + shown(wall_by_edge) + ": " + shown(pressure_Pa) + " Pa");
    last_Pa = pressure_Pa;
    expect_energy_error(outcome, report, 0.01);
  }
}

/// A sphere with a wall of a two-hundredth of its radius. Its elements are fifty times as long as thick.
void run_foil(Outcome& outcome) {
  constexpr double inner_m = 0.01, outer_m = 1.005 * inner_m;
  const meshes::HexahedralMesh mesh = meshes::thick_sphere_octant(inner_m, outer_m, 1, 3);
  fem::Body body = fem::body_of(materials::NeoHookean{shear_modulus_Pa},
                                materials::SimoTaylorVolume{nearly_incompressible * shear_modulus_Pa});
  fem::hold_symmetry(body, mesh);
  fem::add_chambers(body, mesh);
  for (const double stretch : {1.02, 1.2, 1.5}) {
    fem::Model model(mesh, 2, body);
    const fem::PathReport report = follow(model, volume_drive(std::pow(stretch, 3)), fem::equal_steps(10));
    outcome.expect_status(report.status, io::RunStatus::completed, report.reason);
    outcome.expect_near("pressure at " + shown(stretch) + " Pa", report.points.back().pressures_Pa[0],
                        sphere_pressure_Pa(stretch, outer_m / inner_m), 2e-3);
    expect_energy_error(outcome, report, 0.01);
  }
}

}  // namespace

std::vector<Row> fem_wall_rows() {
  std::vector<Row> rows;
  rows.reserve(walls.size() + 2);
  for (const Wall& wall : walls) {
    rows.push_back(
        {.name = "wall of " + shown(wall.by_edge) + " edges",
         .done = "hollow cube, Q2/P1, in the linear range, on a graded mesh and with one element through the wall",
         .expected = "the chamber swells by what finer meshes give, dV/dp = " + shown(wall.swelling) +
                     " edge^3 / mu, to 1 %, twice what fineness changes; no less than by a radial motion and, where a spherical "
                     "shell fits between, no more than that shell; one element through the wall gives " +
                     shown(wall.one_element) + " of it, to 0.02" +
                     (wall.by_edge < 0.03 ? "; faces bulge as clamped plates, which the joints make narrower than the middle "
                                            "planes and wider than the chamber"
                                          : ""),
         .is_slow = wall.by_edge < 0.1,
         .run = [wall](Outcome& outcome) { run_wall(outcome, wall); }});
  }
  rows.push_back(
      {.name = "walls of 0.02 to 0.45 edges inflated",
       .done = "hollow cubes, Q1/P0, volume of the chamber to 1.5 in ten steps",
       .expected = "completed; the thicker the wall the higher the pressure; work is energy to 1 %, the error of trapezoids",
       .run = run_inflated_walls});
  rows.push_back({.name = "element aspect 50",
                  .done = "sphere with a wall of 1/200 of its radius, one Q2/P1 element through it, 2.6 mm by 0.05 mm",
                  .expected = "the closed form to 2e-3 from a stretch of 1.02 to 1.5",
                  .run = run_foil});
  return rows;
}

}  // namespace menger::extremes
