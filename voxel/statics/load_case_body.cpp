#include "voxel/statics/load_case_body.h"

#include <cmath>
#include <stdexcept>

namespace menger::voxel {
namespace {

using meshes::LoadCase;
using meshes::LoadCaseKind;
using meshes::Side;

constexpr double standard_gravity_m_s2 = 9.80665;

std::vector<Side> plates_of(LoadCaseKind kind) {
  switch (kind) {
    case LoadCaseKind::inflation:
      return {};
    case LoadCaseKind::press:
      return {Side::z_max};
    case LoadCaseKind::sag:
    case LoadCaseKind::modes:
      return {Side::x_min};
    case LoadCaseKind::blocked:
    case LoadCaseKind::stretch:
    case LoadCaseKind::shear:
    case LoadCaseKind::bending:
    case LoadCaseKind::torsion:
      return {Side::x_min, Side::x_max};
  }
  return {};
}

HollowVoxels voxels_of(const SurrogateParameters& parameters, const LoadCase& load_case) {
  if (load_case.cell_edge_m != parameters.cell_edge_m || load_case.wall_thickness_m != parameters.wall_thickness_m)
    throw std::invalid_argument("the parameters are not those of the cells of the load case");
  const auto [nx, ny, nz] = load_case.cells;
  return hollow_voxels(meshes::Polycube::from_digits(nx, ny, nz, load_case.digits),
                       {.cell_edge_m = load_case.cell_edge_m,
                        .wall_thickness_m = load_case.wall_thickness_m,
                        .voxels_per_cell = parameters.voxels_per_cell,
                        .level = load_case.level,
                        .chambers = load_case.per_phase ? meshes::ChamberLayout::per_phase : meshes::ChamberLayout::single});
}

/// Motion of the tip plate of a bar of length l that is bent by an angle, along the circular arc of its middle line.
PlateMotion bent(double length, double angle) {
  PlateMotion motion;
  motion.rotation.y = angle;
  if (angle == 0.0) return motion;
  const double sine_of_half = std::sin(0.5 * angle);
  motion.displacement = {length * (std::sin(angle) / angle - 1.0), 0.0, -2.0 * length * sine_of_half * sine_of_half / angle};
  return motion;
}

PlateMotion motion_of(LoadCaseKind kind, double length, double imposed) {
  PlateMotion motion;
  if (kind == LoadCaseKind::stretch) motion.displacement.x = imposed;
  if (kind == LoadCaseKind::shear) motion.displacement.z = imposed;
  if (kind == LoadCaseKind::bending) return bent(length, imposed);
  if (kind == LoadCaseKind::torsion) motion.rotation.x = imposed;
  if (kind == LoadCaseKind::press) motion.displacement.z = -imposed;
  return motion;
}

}  // namespace

StaticBody load_case_body(const SurrogateParameters& parameters, const LoadCase& load_case) {
  return {parameters, voxels_of(parameters, load_case), plates_of(load_case.kind)};
}

Supports load_case_supports(LoadCaseKind kind) {
  Supports supports;
  supports.ground = kind == LoadCaseKind::press;
  if (kind == LoadCaseKind::inflation) supports.fixed_voxels = {0};
  return supports;
}

StaticLoads load_case_loads(LoadCaseKind kind, const StaticBody& body, const std::vector<double>& state) {
  StaticLoads loads;
  loads.pressures_Pa.assign(body.voxels.chamber_count, state.at(0));
  if (meshes::abscissa_count(kind) < 2) return loads;
  if (kind == LoadCaseKind::sag) {
    loads.gravity_m_s2 = standard_gravity_m_s2 * state.at(1);
  } else {
    loads.plates.resize(body.plates.size());
    loads.plates.back() = motion_of(kind, body.box_m[0], state.at(1));
  }
  return loads;
}

std::vector<std::vector<double>> load_case_states(const LoadCase& load_case) {
  std::vector<std::vector<double>> states;
  for (const double pressure : load_case.pressures_Pa) {
    if (meshes::abscissa_count(load_case.kind) == 1) states.push_back({pressure});
    if (meshes::abscissa_count(load_case.kind) == 2) {
      for (const double imposed : load_case.imposed) states.push_back({pressure, imposed});
    }
  }
  return states;
}

}  // namespace menger::voxel
