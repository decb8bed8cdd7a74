#include "voxel/statics/static_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "voxel/engine/rest_lengths.h"
#include "voxel/model/elbows.h"
#include "voxel/model/surrogate_beams.h"

namespace menger::voxel {
namespace {

using meshes::CellIndex;
using meshes::Side;

std::array<int, 3> indices(const CellIndex& cell) { return {cell.x, cell.y, cell.z}; }

/// Smallest and largest cell coordinates of a body along every axis.
struct CellBox {
  std::array<int, 3> low{};
  std::array<int, 3> high{};
};

CellBox cell_box(const Lattice& lattice) {
  CellBox box{indices(lattice.cells.front()), indices(lattice.cells.front())};
  for (const CellIndex& cell : lattice.cells) {
    const std::array<int, 3> at = indices(cell);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], at[axis]);
      box.high[axis] = std::max(box.high[axis], at[axis]);
    }
  }
  return box;
}

bool is_at_end(const CellBox& box, const CellIndex& cell, Side side) {
  const std::size_t axis = meshes::axis_of(side);
  return indices(cell)[axis] == (meshes::is_max(side) ? box.high : box.low)[axis];
}

Vector3<double> vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

std::size_t position(std::int32_t index) { return static_cast<std::size_t>(index); }

/// The middle of a side of a box with one corner at the origin.
std::array<double, 3> middle_of_side(const std::array<double, 3>& size, Side side) {
  std::array<double, 3> middle{0.5 * size[0], 0.5 * size[1], 0.5 * size[2]};
  const std::size_t axis = meshes::axis_of(side);
  middle[axis] = meshes::is_max(side) ? size[axis] : 0.0;
  return middle;
}

void add_voxels(StaticBody& body, const CellBox& box) {
  const double edge = body.edge_m;
  for (std::size_t axis = 0; axis < 3; ++axis) body.box_m[axis] = edge * (box.high[axis] - box.low[axis] + 1);
  for (const CellIndex& cell : body.lattice.cells) {
    std::array<double, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = edge * (indices(cell)[axis] - box.low[axis] + 0.5);
    body.rest.push_back({vector(at), {1.0, 0.0, 0.0, 0.0}});
  }
  body.mass_kg = voxel_masses(body.voxels, body.parameters.density_kg_m3);
  for (std::size_t i = 0; i < body.mass_kg.size(); ++i)
    body.inertia_kg_m2.push_back(body.mass_kg[i] * edge * edge / 6.0 * body.voxels.inertia_factor[i]);
}

void add_beams(StaticBody& body) {
  const HollowVoxels& voxels = body.voxels;
  const auto elbows = elbow_turns(body.lattice, voxels, body.parameters.voxels_per_cell);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& along = body.lattice.beams[axis];
    for (std::size_t i = 0; i < along.lower.size(); ++i) {
      const std::size_t lower = position(along.lower[i]);
      const std::size_t upper = position(along.upper[i]);
      const SectionStiffness section =
          beam_section(body.parameters, voxels.wall_class[lower][axis], voxels.wall_class[upper][axis],
                       voxels.chamber[lower] != voxels.chamber[upper]);
      body.beam_at[lower][2 * axis + 1] = body.beam_at[upper][2 * axis] = body.beams.size();
      body.beams.push_back({static_cast<int>(axis), lower, upper, beam_coefficients(section, body.edge_m), elbows[axis][i]});
    }
  }
}

void add_plate(StaticBody& body, Side side) {
  const std::size_t axis = meshes::axis_of(side);
  const bool is_max = meshes::is_max(side);
  const double half = 0.5 * body.edge_m;
  for (const std::size_t voxel : body.end_voxels(side)) {
    const std::size_t node = body.rest.size();
    const Vector3<double> centre = body.rest[voxel].position;
    std::array<double, 3> at{centre.x, centre.y, centre.z};
    at[axis] += is_max ? half : -half;
    body.rest.push_back({vector(at), {1.0, 0.0, 0.0, 0.0}});
    body.places.push_back({body.plates.size(), voxel});
    body.beam_at[voxel][static_cast<std::size_t>(side)] = body.beams.size();
    const SectionStiffness section = section_of(body.parameters, body.voxels.wall_class[voxel][axis]);
    body.beams.push_back(
        {static_cast<int>(axis), is_max ? voxel : node, is_max ? node : voxel, beam_coefficients(section, half), {}});
  }
  body.plates.push_back({side, vector(middle_of_side(body.box_m, side))});
}

}  // namespace

StaticBody::StaticBody(const SurrogateParameters& body_parameters, HollowVoxels hollow, const std::vector<Side>& plate_sides)
    : parameters(body_parameters),
      voxels(std::move(hollow)),
      lattice(voxels.body),
      edge_m(parameters.voxel_edge_m()),
      openings(wall_openings(lattice, voxels, parameters.voxels_per_cell)),
      beam_at(lattice.voxel_count()) {
  has_class = law_classes_of(voxels);
  add_voxels(*this, cell_box(lattice));
  add_beams(*this);
  for (const Side side : plate_sides) add_plate(*this, side);
}

std::vector<std::size_t> StaticBody::end_voxels(Side side) const {
  const CellBox box = cell_box(lattice);
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < voxel_count(); ++i) {
    if (is_at_end(box, lattice.cells[i], side)) ends.push_back(i);
  }
  return ends;
}

double StaticBody::rest_length(const DrivenSizes& sizes, const StaticBeam& beam) const {
  double length = 0.0;
  for (const std::size_t node : {beam.lower, beam.upper}) {
    if (!is_voxel(node)) continue;
    const auto axis = static_cast<std::size_t>(beam.axis);
    const std::size_t side = 2 * axis + (node == beam.lower ? 1 : 0);
    length += half_length(sizes, node, side) + edge_m * crown_sum(sizes, node, openings[node][side].lift);
  }
  return length;
}

AcrossBeam<double> StaticBody::half_kink(const DrivenSizes& sizes, const StaticBeam& beam) const {
  AcrossBeam<double> half{};
  if (beam.elbow != AcrossBeam<double>{}) {  // of a beam between two voxels
    const auto axis = static_cast<std::size_t>(beam.axis);
    const double strain =
        (half_length(sizes, beam.lower, 2 * axis + 1) + half_length(sizes, beam.upper, 2 * axis)) / edge_m - 1.0;
    for (std::size_t k = 0; k < half.size(); ++k) half[k] = 0.5 * parameters.elbow_ratio * strain * beam.elbow[k];
  }
  for (const std::size_t node : {beam.lower, beam.upper}) {
    if (!is_voxel(node)) continue;
    const std::size_t side = 2 * static_cast<std::size_t>(beam.axis) + (node == beam.lower ? 1 : 0);
    const WallOpening& opening = openings[node][side];
    for (std::size_t k = 0; k < half.size() && opening.tilts; ++k) half[k] += 0.5 * crown_sum(sizes, node, opening.turn[k]);
  }
  return half;
}

double StaticBody::crown_sum(const DrivenSizes& sizes, std::size_t voxel, const ByLawClass<double>& shares) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < law_class_count; ++c)
    sum += shares[c] * parameters.bulge_peak_ratio_of(c) * sizes.bulge[voxels.chamber[voxel]][c];
  return parameters.neck_ratio * sum;
}

std::optional<DrivenSizes> driven_sizes(const StaticBody& body, const std::vector<double>& pressures_Pa) {
  const SurrogateParameters& parameters = body.parameters;
  const double smallest = 0.1 * 0.5 * parameters.voxel_edge_m();
  DrivenSizes sizes;
  sizes.pressures_Pa = pressures_Pa;
  for (const double pressure : pressures_Pa) {
    ByLawClass<double> half_lengths{};
    ByLawClass<double> bulges{};
    for (std::size_t c = 0; c < law_class_count; ++c) {
      if (!body.has_class[c]) continue;
      const PressureLaw bulge = parameters.bulge_of(c);
      if (!parameters.extension_of(c).has_value(pressure) || !bulge.has_value(pressure)) return std::nullopt;
      half_lengths[c] = half_length_m(parameters, c, pressure);
      bulges[c] = bulge.value(pressure);
      if (!(half_lengths[c] >= smallest) || !std::isfinite(half_lengths[c]) || !std::isfinite(bulges[c])) return std::nullopt;
    }
    sizes.half_m.push_back(half_lengths);
    sizes.bulge.push_back(bulges);
  }
  return sizes;
}

}  // namespace menger::voxel
