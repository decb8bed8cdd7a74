#include "fem/load_cases/load_case_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/inflation/wall_points.h"
#include "fem/memory/memory_estimate.h"
#include "fem/statics/free_supports.h"
#include "io/process/machine_memory.h"
#include "io/text/input_error.h"
#include "materials/laws/hyperelastic_law.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/load_cases/body_feet.h"

namespace menger::fem {
namespace {

using meshes::LoadCase;
using meshes::LoadCaseKind;

constexpr double standard_gravity_m_per_s2 = 9.80665;

/// Stiffness of the rigid ground over shear modulus and wall thickness: under a pressure of a tenth of the modulus it yields by a
/// thousandth of the wall.
constexpr double ground_stiffness_factor = 100.0;

meshes::HexahedralMesh make_mesh(const LoadCase& load_case, const LoadCaseElements& elements) {
  meshes::Design design;
  design.name = load_case.name;
  const auto& [nx, ny, nz] = load_case.cells;
  design.body = meshes::Polycube::from_digits(nx, ny, nz, load_case.digits);
  design.cell_edge_m = load_case.cell_edge_m;
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = load_case.wall_thickness_m;
  if (elements.has_thin_walls()) {
    set_elements(elements.choice, options);
  } else {
    options.elements_through_wall = elements.through_wall;
    options.largest_element_m = elements.largest_element_m;
    options.growth = elements.growth;
  }
  options.chambers = load_case.per_phase ? meshes::ChamberLayout::per_phase : meshes::ChamberLayout::single;
  options.level = load_case.level;
  const std::string name = "load case \"" + load_case.name + "\": ";
  meshes::HexahedralMesh mesh;
  try {
    mesh = meshes::hollow_polycube(design, options).mesh;
  } catch (const io::InputError& error) {
    throw io::InputError(name + error.what());
  }
  for (meshes::Chamber& chamber : mesh.chambers) chamber.plenum = 0;  // one pressure in all of them
  return mesh;
}

}  // namespace

LoadCaseBody::LoadCaseBody(const LoadCase& load_case, const StudyMaterial& material, const LoadCaseElements& elements,
                           MPI_Comm communicator)
    : load_case_(load_case) {
  const meshes::HexahedralMesh mesh = make_mesh(load_case, elements);
  low_ = high_ = mesh.points.front();
  for (const Point& point : mesh.points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], point[axis]);
      high_[axis] = std::max(high_[axis], point[axis]);
    }
  }
  body_.regions.assign(mesh.region_names.size(), {material.law, material.volume, material.density_kg_per_m3.value_or(0.0)});
  for (const meshes::Chamber& chamber : mesh.chambers) body_.chambers.push_back({chamber.labels, chamber.plenum});
  body_.plenum_count = 1;
  if (elements.has_thin_walls()) body_.thin_walls = ThinWallBody{.places = thin_wall_places(mesh)};
  add_grips(mesh);
  if (body_.ground)
    body_.ground->stiffness_Pa_per_m =
        ground_stiffness_factor * materials::shear_modulus_at_rest_Pa(material.law) / load_case.wall_thickness_m;
  space_ = make_space(mesh, elements.space_degree(), 0, communicator);
  equilibrium_ = std::make_unique<Equilibrium>(space_, body_, EquilibriumOptions{});
  ends_ = std::make_unique<BodyEnds>(space_, low_, high_);
  std::vector<NamedPoint> top;
  for (const Point& cells : top_of(load_case).points) top.push_back({"top centre", scaled(load_case.cell_edge_m, cells)});
  top_ = locate_points(space_, top);
  add_soles();
  rest_volume_m3_ = equilibrium_->plenum_volumes(equilibrium_->totals(equilibrium_->rest())).front();
}

void LoadCaseBody::add_grips(const meshes::HexahedralMesh& mesh) {
  const Point middle = scaled(0.5, sum(low_, high_));
  const auto plate = [&](std::size_t axis, double position_m) {
    Point centre = middle;
    centre[axis] = position_m;
    body_.plates.push_back({.faces = {.plane = AxisPlane{axis, position_m}}, .centre = centre});
  };
  switch (load_case_.kind) {
    case LoadCaseKind::inflation:
      body_.point_supports = free_supports(mesh.points);
      break;
    case LoadCaseKind::blocked:
    case LoadCaseKind::stretch:
    case LoadCaseKind::shear:
    case LoadCaseKind::bending:
    case LoadCaseKind::torsion:
      plate(0, low_[0]);
      plate(0, high_[0]);
      break;
    case LoadCaseKind::press: {
      plate(2, high_[2]);
      body_.ground = GroundPlane{.height_m = low_[2]};
      const auto& names = mesh.label_names;
      for (std::size_t label = 0; label < names.size(); ++label)
        if (names[label] == "ground" || names[label] == "outer") body_.ground_labels.push_back(label);
      break;
    }
    case LoadCaseKind::sag:
      body_.gravity_m_per_s2 = {0.0, 0.0, -standard_gravity_m_per_s2};
      plate(0, low_[0]);
      break;
    case LoadCaseKind::modes:
      plate(0, low_[0]);
      break;
  }
}

void LoadCaseBody::add_soles() {
  if (meshes::response_columns(load_case_).size() == meshes::response_columns(load_case_.kind).size()) return;
  const std::vector<std::array<int, 3>> cells = meshes::occupied_cells(load_case_.cells, load_case_.digits);
  const std::array<int, 3> lowest = meshes::occupied_box(load_case_.cells, load_case_.digits).lowest;
  for (const std::vector<std::size_t>& foot : meshes::feet_of(cells)) {
    FaceSet sole{.plane = AxisPlane{2, low_[2]}};
    for (const std::size_t cell : foot) {
      std::array<Point, 2> box{low_, low_};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box[0][axis] += load_case_.cell_edge_m * (cells[cell][axis] - lowest[axis]);
        box[1][axis] = box[0][axis] + load_case_.cell_edge_m;
      }
      sole.boxes.push_back(box);
    }
    soles_.emplace_back(sole, space_);
  }
}

PathDrives LoadCaseBody::at_rest() const {
  PathDrives drives;
  drives.plena = {{.kind = DriveKind::pressure, .values = {0.0}}};
  drives.plates.resize(body_.plates.size());
  drives.dead_load_factors = {0.0};
  return drives;
}

PathDrives LoadCaseBody::impose(double value) const {
  PathDrives drives = at_rest();
  PlateMotion motion;
  switch (load_case_.kind) {
    case LoadCaseKind::stretch:
      motion.displacement_m[0] = value;
      break;
    case LoadCaseKind::shear:
      motion.displacement_m[2] = value;
      break;
    case LoadCaseKind::bending:
      motion.rotation_rad[1] = value;
      drives.plates.back().arc_length_m = high_[0] - low_[0];
      break;
    case LoadCaseKind::torsion:
      motion.rotation_rad[0] = value;
      break;
    case LoadCaseKind::press:
      motion.displacement_m[2] = -value;
      break;
    case LoadCaseKind::sag:
      drives.dead_load_factors = {0.0, value};
      return drives;
    case LoadCaseKind::inflation:
    case LoadCaseKind::blocked:
    case LoadCaseKind::modes:
      return drives;
  }
  drives.plates.back().values = {{}, motion};
  return drives;
}

Point LoadCaseBody::top_displacement_m(const BodyState& state) const {
  std::vector<PointObservation> top;
  for (const LocatedPoint& point : top_) {
    Point displacement_m{};
    for (std::size_t n = 0; n < point.nodes.size(); ++n) {
      for (std::size_t i = 0; i < 3; ++i)
        displacement_m[i] += point.weights[n] * state.displacements_m[3 * static_cast<std::size_t>(point.nodes[n]) + i];
    }
    MPI_Bcast(displacement_m.data(), 3, MPI_DOUBLE, point.rank, space_.communicator);
    top.push_back({.displacement_m = displacement_m});
  }
  if (body_.thin_walls) add_wall_rises(equilibrium_->assembly(), top_, state, top);
  Point mean{};
  for (const PointObservation& point : top) mean = sum(mean, scaled(1.0 / static_cast<double>(top.size()), point.displacement_m));
  return mean;
}

double LoadCaseBody::top_rise_m(const BodyState& state) const {
  const Point& bottom = ends_->at_rest()[2][0];
  const meshes::EndPoints ends = ends_->deformed(state.displacements_m);
  Point top{};
  for (const LocatedPoint& located : top_) top = sum(top, scaled(1.0 / static_cast<double>(top_.size()), located.point.position));
  const Point at_rest = difference(top, bottom);
  const Point moved = sum(at_rest, difference(top_displacement_m(state), difference(ends[2][0], bottom)));
  const auto height = [&](const meshes::EndPoints& present, const Point& offset) {
    const auto R = meshes::rotation_of_body(ends_->at_rest(), present);
    return R[0][2] * offset[0] + R[1][2] * offset[1] + R[2][2] * offset[2];
  };
  return height(ends, moved) - height(ends_->at_rest(), at_rest);
}

std::vector<double> LoadCaseBody::ordinates(const PathPoint& point, const BodyState& state) const {
  const double volume_change = point.plenum_volumes_m3.front() / rest_volume_m3_ - 1.0;
  switch (load_case_.kind) {
    case LoadCaseKind::inflation: {
      const Point growth_m = ends_->extent_changes_without_rotation_m(state.displacements_m);
      std::vector<double> row{volume_change, growth_m[0], growth_m[1], growth_m[2], top_rise_m(state)};
      std::vector<Point> feet_at_rest;
      std::vector<Point> feet;
      feet_at_rest.reserve(soles_.size());
      feet.reserve(soles_.size());
      for (const FaceMean& sole : soles_) {
        feet_at_rest.push_back(sole.position_m());
        feet.push_back(sum(feet_at_rest.back(), sole.displacement_m(state.displacements_m)));
      }
      const std::vector<double> outwards =
          meshes::feet_outwards_m(feet_at_rest, feet, ends_->at_rest(), ends_->deformed(state.displacements_m));
      row.insert(row.end(), outwards.begin(), outwards.end());
      return row;
    }
    case LoadCaseKind::blocked:
      return {point.plates.back().force_N[0], volume_change};
    case LoadCaseKind::stretch: {
      const Point growth_m = ends_->extent_changes_m(state.displacements_m);
      return {point.plates.back().force_N[0], volume_change, growth_m[1], growth_m[2]};
    }
    case LoadCaseKind::shear:
      return {point.plates.back().force_N[2]};
    case LoadCaseKind::bending:
      return {point.plates.back().moment_N_m[1]};
    case LoadCaseKind::torsion:
      return {point.plates.back().moment_N_m[0]};
    case LoadCaseKind::press:
      return {point.ground_force_N};
    case LoadCaseKind::sag:
      return {ends_->deformed(state.displacements_m)[0][1][2] - ends_->at_rest()[0][1][2]};
    case LoadCaseKind::modes:
      return {};
  }
  return {};
}

void require_meshable(const LoadCase& load_case, const LoadCaseElements& elements) {
  const meshes::HexahedralMesh mesh = make_mesh(load_case, elements);
  const int degree = elements.space_degree();
  const std::string obstacle = obstacle_of_memory(body_size(mesh, degree, 0), degree, {}, io::machine_memory_bytes());
  if (obstacle.empty()) return;
  throw io::InputError("load case \"" + load_case.name + "\": " + obstacle + "; lower elements.degree = " +
                       std::to_string(elements.degree) + " or elements.through_wall = " + std::to_string(elements.through_wall) +
                       ", or give elements.largest_element_m or elements.kind = \"thin_wall\"");
}

}  // namespace menger::fem
