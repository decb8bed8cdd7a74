#include "fem_cross_code.h"

#include "fem_table.h"

namespace menger::fem {

void expect_published(const PublishedCube& published) {
  Model model(meshes::hollow_cube_quarter(cube_edge_m, cube_wall_m, published.elements_through_wall), published.degree,
              quarter_of_cube(published.formulation));
  PathOptions options;
  options.first_step = 0.25;
  model.follow({{.kind = DriveKind::pressure, .values = {0.0, 6000.0}}}, options);
  constexpr double tolerance = 1e-4;
  expect_close(published.name + ", top mm", 1e3 * model.displacement_at(cube_top)[2], published.top_mm, tolerance);
  expect_close(published.name + ", side mm", 1e3 * model.displacement_at(cube_side)[0], published.side_mm, tolerance);
  expect_close(published.name + ", volume %", 100.0 * (model.plenum_volume_ratio(0) - 1.0), published.volume_percent, tolerance);
  expect_close(published.name + ", energy J", 4.0 * model.strain_energy_J(), published.energy_J, tolerance);
}

}  // namespace menger::fem
