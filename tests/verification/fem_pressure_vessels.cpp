#include "fem_pressure_vessels.h"

#include <cmath>

#include "meshes/hexahedra/verification_shapes.h"

namespace menger::fem {

meshes::HexahedralMesh vessel_mesh(Vessel vessel, std::size_t fineness) {
  if (vessel == Vessel::sphere) return meshes::thick_sphere_octant(inner_radius_m, outer_radius_m, fineness, 2 * fineness);
  return meshes::thick_cylinder_quarter(inner_radius_m, outer_radius_m, 2e-3, {fineness, 4 * fineness, 1});
}

Body vessel_body(const VesselCase& vessel) {
  const meshes::HexahedralMesh mesh = vessel_mesh(vessel.vessel, 1);
  Body body = body_of(vessel.law, materials::SimoTaylorVolume{vessel.bulk_modulus_Pa}, vessel.formulation);
  hold_symmetry(body, mesh);
  if (vessel.vessel == Vessel::cylinder) hold(body, mesh, "end", {false, false, true});
  add_chambers(body, mesh);
  return body;
}

std::vector<VesselState> inflate(const VesselCase& vessel, std::size_t fineness, const std::vector<double>& inner_stretches) {
  Model model(vessel_mesh(vessel.vessel, fineness), vessel.degree, vessel_body(vessel));
  const double dimensions = vessel.vessel == Vessel::sphere ? 3.0 : 2.0;
  PlenumDrive drive{.kind = DriveKind::volume, .values = {1.0}};
  for (const double stretch : inner_stretches) drive.values.push_back(std::pow(stretch, dimensions));

  std::vector<VesselState> states;
  model.follow({drive}, PathOptions{}, [&](const PathPoint& point) {
    if (point.step == 0 || point.s != std::round(point.s)) return;
    const Point displacement = model.displacement_at({outer_radius_m, 0.0, 0.0});
    states.push_back({point.pressures_Pa[0], 1.0 + displacement[0] / outer_radius_m});
  });
  return states;
}

std::vector<double> incompressible_pressures_Pa(VesselCase vessel, std::size_t fineness,
                                                const std::vector<double>& inner_stretches) {
  vessel.bulk_modulus_Pa = 1e4 * vessel_shear_modulus_Pa;
  const auto softer = inflate(vessel, fineness, inner_stretches);
  vessel.bulk_modulus_Pa *= 2.0;
  const auto stiffer = inflate(vessel, fineness, inner_stretches);
  std::vector<double> pressures_Pa;
  for (std::size_t n = 0; n < softer.size(); ++n) pressures_Pa.push_back(2.0 * stiffer[n].pressure_Pa - softer[n].pressure_Pa);
  return pressures_Pa;
}

}  // namespace menger::fem
