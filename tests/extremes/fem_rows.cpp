#include "tests/extremes/fem_rows.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>

#include "meshes/hexahedra/hollow_polycube.h"
#include "tests/extremes/part.h"

namespace menger::extremes {

double bulk_ratio(double poissons_ratio) { return 2.0 * (1.0 + poissons_ratio) / (3.0 * (1.0 - 2.0 * poissons_ratio)); }

double sphere_pressure_Pa(double inner_stretch, double radius_ratio) {
  const double outer_stretch = std::cbrt(1.0 + (std::pow(inner_stretch, 3) - 1.0) / std::pow(radius_ratio, 3));
  const auto term = [](double stretch) { return 4.0 / stretch + std::pow(stretch, -4); };
  return 0.5 * shear_modulus_Pa * (term(outer_stretch) - term(inner_stretch));
}

fem::PathReport follow(fem::Model& model, const fem::PlenumDrive& drive, const fem::PathOptions& options,
                       std::size_t most_points) {
  std::atomic<bool> stop = false;
  model.report = fem::follow_path(
      model.equilibrium, std::vector<fem::PlenumDrive>{drive}, options,
      [&](const fem::PathPoint&, const fem::BodyState& reached, const fem::PathRestart& restart) {
        model.state = reached;
        stop = restart.points.size() >= most_points;
      },
      &stop);
  return model.report;
}

void expect_energy_error(Outcome& outcome, const fem::PathReport& report, double bound) {
  double largest_J = 0.0;
  for (const fem::PathPoint& point : report.points) largest_J = std::max(largest_J, point.strain_energy_J);
  outcome.expect_energy_error((report.points.back().work_J - report.points.back().strain_energy_J) / largest_J, bound);
}

fem::PlenumDrive pressure_drive(double pressure_Pa) { return {.kind = fem::DriveKind::pressure, .values = {0.0, pressure_Pa}}; }

fem::PlenumDrive volume_drive(double volume_ratio) { return {.kind = fem::DriveKind::volume, .values = {1.0, volume_ratio}}; }

double volume_ratio(const fem::PathReport& report) {
  return report.points.back().plenum_volumes_m3[0] / report.points.front().plenum_volumes_m3[0];
}

HollowCube::HollowCube(double wall_by_edge, int elements_through_wall, double modulus_Pa) {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = wall_by_edge * edge_m;
  options.elements_through_wall = elements_through_wall;
  options.largest_element_m = std::max(options.wall_thickness_m, edge_m / 6.0);
  options.growth = 2.0;
  mesh = meshes::hollow_polycube(meshes::hollow_cube_design(edge_m), options).mesh;
  body = fem::body_of(materials::NeoHookean{modulus_Pa}, materials::SimoTaylorVolume{nearly_incompressible * modulus_Pa});
  body.point_supports = {{{0.0, 0.0, 0.0}, {true, true, true}},
                         {{edge_m, 0.0, 0.0}, {false, true, true}},
                         {{0.0, edge_m, 0.0}, {false, false, true}}};
  fem::add_chambers(body, mesh);
}

Part part() {
  Part part{.name = "fem", .rows = {}};
  for (auto& rows : {fem_incompressibility_rows(), fem_wall_rows(), fem_path_rows(), fem_input_rows(), fem_solid_bar_rows()})
    std::copy(rows.begin(), rows.end(), std::back_inserter(part.rows));
  return part;
}

}  // namespace menger::extremes
