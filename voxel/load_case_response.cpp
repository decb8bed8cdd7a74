#include "voxel/load_case_response.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "io/number_text.h"
#include "voxel/body_shape.h"
#include "voxel/vibration.h"

namespace menger::voxel {
namespace {

using materials::LoadCase;
using materials::LoadCaseKind;
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

Supports supports_of(LoadCaseKind kind) {
  Supports supports;
  supports.ground = kind == LoadCaseKind::press;
  if (kind == LoadCaseKind::inflation) supports.fixed_voxels = {0};
  return supports;
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

/// How the tip plate of a bar of length l moves when it is bent by an angle: along the circular arc of its middle line.
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

StaticLoads loads_of(LoadCaseKind kind, const StaticBody& body, const std::vector<double>& state) {
  StaticLoads loads;
  loads.pressures_Pa.assign(body.voxels.chamber_count, state.at(0));
  if (materials::abscissa_count(kind) < 2) return loads;
  if (kind == LoadCaseKind::sag) {
    loads.gravity_m_s2 = standard_gravity_m_s2 * state.at(1);
  } else {
    loads.plates.resize(body.plates.size());
    loads.plates.back() = motion_of(kind, body.box_m[0], state.at(1));
  }
  return loads;
}

std::vector<std::vector<double>> states_of(const LoadCase& load_case) {
  std::vector<std::vector<double>> states;
  for (const double pressure : load_case.pressures_Pa) {
    if (materials::abscissa_count(load_case.kind) == 1) states.push_back({pressure});
    if (materials::abscissa_count(load_case.kind) == 2) {
      for (const double imposed : load_case.imposed) states.push_back({pressure, imposed});
    }
  }
  return states;
}

double force_on(LoadCaseKind kind, const Equilibrium& equilibrium) {
  if (kind == LoadCaseKind::press) return equilibrium.ground_force_N();
  const PlateLoad load = equilibrium.plate_load(1);
  return kind == LoadCaseKind::shear ? load.force.z : load.force.x;
}

double moment_on(LoadCaseKind kind, const Equilibrium& equilibrium) {
  const PlateLoad load = equilibrium.plate_load(1);
  return kind == LoadCaseKind::torsion ? load.moment.x : load.moment.y;
}

/// Extents and height of the top by what the body is held at: a free one is seen in its own frame.
BodyShape::FreeSize size_of(const BodyShape& shape, LoadCaseKind kind) {
  if (kind == LoadCaseKind::inflation) return shape.free_size();
  return {.extents = {shape.extent(0), shape.extent(1), shape.extent(2)}, .top_height = shape.top_height()};
}

double tip_height_at_rest(const StaticBody& body) {
  double sum = 0.0;
  const std::vector<std::size_t> tip = body.end_voxels(Side::x_max);
  for (const std::size_t voxel : tip) sum += body.rest[voxel].position.z;
  return sum / static_cast<double>(tip.size());
}

/// One number of a row other than frequencies, by the name of its column. @param size of the shape, see size_of
double observed(const std::string& column, LoadCaseKind kind, const Equilibrium& equilibrium, const BodyShape& shape,
                const BodyShape::FreeSize& size) {
  const StaticBody& body = equilibrium.balance().body();
  if (column == "force_N") return force_on(kind, equilibrium);
  if (column == "moment_N_m") return moment_on(kind, equilibrium);
  if (column == "volume_change") return shape.chamber_volume_change();
  if (column == "extent_x_m") return size.extents[0] - body.box_m[0];
  if (column == "extent_y_m") return size.extents[1] - body.box_m[1];
  if (column == "extent_z_m") return size.extents[2] - body.box_m[2];
  if (column == "top_m") return size.top_height - body.box_m[2];
  if (column == "tip_m") return shape.tip_height() - tip_height_at_rest(body);
  throw std::logic_error("the surrogate does not know the column " + column);
}

/// Which wall class ends at a pressure.
std::string beyond_laws(const StaticBody& body, double pressure_Pa) {
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    if (!body.has_class[c]) continue;
    for (const PressureLaw& law : {body.parameters.extension[c], body.parameters.bulge[c]}) {
      if (!law.has_value(pressure_Pa)) {
        return "wall class " + std::string(wall_class_names[c]) +
               " has no equilibrium at pressure_Pa = " + io::number_text(pressure_Pa);
      }
    }
  }
  return "a wall class has no length left at pressure_Pa = " + io::number_text(pressure_Pa);
}

std::string contact_text(const StaticBody& body, const BodyShape::WallContact& contact) {
  const auto& [x, y, z] = body.lattice.cells[contact.voxel];
  return std::string("chamber walls across ") + "xyz"[contact.axis] + " meet at voxel " + std::to_string(x) + ", " +
         std::to_string(y) + ", " + std::to_string(z);
}

/// The ordinates of a row; nothing where the equilibrium is not stable and so vibrates at no frequency.
std::vector<double> ordinates(const LoadCaseResponse& response, LoadCaseKind kind, const Equilibrium& equilibrium) {
  const std::size_t first = materials::abscissa_count(kind);
  const std::size_t count = response.columns.size() - first;
  if (kind == LoadCaseKind::modes) {
    const Vibrations vibrations = natural_vibrations(small_motion(equilibrium), count);
    const bool all_there = vibrations.unstable_count == 0 && vibrations.frequencies_Hz.size() == count;
    return all_there ? vibrations.frequencies_Hz : std::vector<double>{};
  }
  std::vector<double> row;
  const BodyShape shape(equilibrium);
  const BodyShape::FreeSize size = size_of(shape, kind);
  for (std::size_t i = first; i < response.columns.size(); ++i)
    row.push_back(observed(response.columns[i], kind, equilibrium, shape, size));
  return row;
}

}  // namespace

LoadCaseResponse respond(const SurrogateParameters& parameters, const LoadCase& load_case,
                         const std::vector<std::vector<double>>& states) {
  return visit_states(parameters, load_case, states, [](std::size_t, const Equilibrium&) {});
}

LoadCaseResponse visit_states(const SurrogateParameters& parameters, const LoadCase& load_case,
                              const std::vector<std::vector<double>>& states, const StateVisitor& visit) {
  const LoadCaseKind kind = load_case.kind;
  const StaticBody body(parameters, voxels_of(parameters, load_case), plates_of(kind));
  Equilibrium equilibrium(body, supports_of(kind));
  LoadCaseResponse response;
  response.columns = materials::response_columns(kind);
  response.values.resize(response.columns.size());
  for (const std::vector<double>& state : states.empty() ? states_of(load_case) : states) {
    response.status = equilibrium.load(loads_of(kind, body, state));
    if (response.status == io::RunStatus::limit_point) response.reason = beyond_laws(body, state.front());
    if (response.status != io::RunStatus::completed) return response;
    if (const auto contact = BodyShape(equilibrium).wall_contact()) {
      response.status = io::RunStatus::wall_contact;
      response.reason = contact_text(body, *contact);
      return response;
    }
    std::vector<double> row(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(materials::abscissa_count(kind)));
    const std::vector<double> answer = ordinates(response, kind, equilibrium);
    if (answer.empty()) {
      response.status = io::RunStatus::limit_point;
      response.reason = "the equilibrium is not stable";
      return response;
    }
    row.insert(row.end(), answer.begin(), answer.end());
    for (std::size_t i = 0; i < row.size(); ++i) response.values[i].push_back(row[i]);
    for (std::size_t beam = 0; beam < body.beams.size(); ++beam) {
      const double strain = equilibrium.axial_strain(beam);
      response.smallest_strain = std::min(response.smallest_strain, strain);
      response.largest_strain = std::max(response.largest_strain, strain);
    }
    visit(response.values.front().size() - 1, equilibrium);
  }
  return response;
}

}  // namespace menger::voxel
