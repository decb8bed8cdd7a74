#include "evolution/trade_off_settled.h"

#include <cassert>
#include <cmath>

#include "evolution/trade_off_body.h"
#include "io/input_error.h"
#include "io/number_text.h"
#include "io/toml_document.h"
#include "voxel/surrogate_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using meshes::Side;
using voxel::Vector3;

/// @throws io::InputError unless the parameters of a file are those of the study's body
void require_subject(const TradeStudy& study, const voxel::SurrogateParameters& parameters, const fs::path& file) {
  const auto refuse = [&](const std::string& key, const std::string& value, const std::string& wanted) {
    throw io::InputError(file.string() + ": holds_for." + key + " = " + value + ": " + study.file.string() + " has " + wanted);
  };
  const auto require_text = [&](const std::string& key, const std::string& value, const std::string& wanted) {
    if (value != wanted) refuse(key, io::toml_quoted(value), io::toml_quoted(wanted));
  };
  const auto require_length = [&](const std::string& key, double value, double wanted) {
    constexpr double rounding = 1e-9;  // files may give a length in other digits
    if (!(std::abs(value - wanted) <= rounding * wanted)) refuse(key, io::number_text(value), io::number_text(wanted));
  };
  require_text("silicone", parameters.silicone, study.silicone_name);
  require_text("law", parameters.law, study.law);
  require_length("cell_edge_m", parameters.cell_edge_m, study.design.cell_edge_m);
  require_length("wall_thickness_m", parameters.wall_thickness_m, study.wall_thickness_m);
}

voxel::StaticBody body_of(const TradeStudy& study, const fs::path& file) {
  const voxel::SurrogateParameters parameters = voxel::read_surrogate(file);
  require_subject(study, parameters, file);
  return {parameters,
          voxel::hollow_voxels(study.design.body, {.cell_edge_m = parameters.cell_edge_m,
                                                   .wall_thickness_m = parameters.wall_thickness_m,
                                                   .voxels_per_cell = parameters.voxels_per_cell,
                                                   .level = study.level,
                                                   .chambers = chamber_layout(study)}),
          {}};
}

double length_of(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

}  // namespace

SettledBody::SettledBody(const TradeStudy& study, const fs::path& parameters)
    : file_(parameters), body_(body_of(study, parameters)) {}

void SettledBody::require_sizes(double pressure_Pa) const {
  if (!voxel::driven_sizes(body_, std::vector(body_.voxels.chamber_count, pressure_Pa)))
    throw io::InputError(file_.string() + ": a wall of the body has no size at pressure_Pa = " + io::number_text(pressure_Pa));
}

voxel::DrivenSizes SettledBody::sizes(double pressure_Pa) const {
  const auto driven = voxel::driven_sizes(body_, std::vector(body_.voxels.chamber_count, pressure_Pa));
  assert(driven);
  return driven.value_or(voxel::DrivenSizes{});
}

double SettledBody::length_m(const voxel::StaticBeam& beam, const Voxels& now) const {
  return length_of(now[beam.upper].middle - now[beam.lower].middle);
}

double SettledBody::half_length_m(std::size_t voxel, Side side, const Voxels& now, const voxel::DrivenSizes& sizes) const {
  const auto& beams = body_.beam_at[voxel];
  if (const auto beam = beams[static_cast<std::size_t>(side)]) return 0.5 * length_m(body_.beams[*beam], now);
  const std::size_t axis = meshes::axis_of(side);
  double across = 0.0;  // sum over both other axes of half the strains of the beams
  for (const Side other : meshes::all_sides) {
    const std::size_t along = meshes::axis_of(other);
    const auto beam = beams[static_cast<std::size_t>(other)];
    if (along == axis || !beam) continue;
    const voxel::StaticBeam& ends = body_.beams[*beam];
    const double rest_m = body_.half_length(sizes, ends.lower, along) + body_.half_length(sizes, ends.upper, along);
    across += 0.5 * (length_m(ends, now) / rest_m - 1.0);
  }
  return body_.half_length(sizes, voxel, axis) * (1.0 - body_.parameters.lateral_coupling * across);
}

double SettledBody::bulge_m(std::size_t voxel, Side side, const voxel::DrivenSizes& sizes) const {
  const auto at = static_cast<std::size_t>(side);
  if (!body_.voxels.walled[voxel][at] || body_.beam_at[voxel][at]) return 0.0;
  return body_.bulge(sizes, voxel, meshes::axis_of(side));
}

materials::EndPoints SettledBody::ends(const Voxels& now, const voxel::DrivenSizes& sizes) const {
  materials::EndPoints points{};
  for (const Side side : meshes::all_sides) {
    const std::size_t axis = meshes::axis_of(side);
    const std::vector<std::size_t> voxels = body_.end_voxels(side);
    Vector3<double> sum{0.0, 0.0, 0.0};
    for (const std::size_t voxel : voxels) {
      const double distance_m = half_length_m(voxel, side, now, sizes) + bulge_m(voxel, side, sizes);
      sum = sum + now[voxel].middle + (meshes::is_max(side) ? distance_m : -distance_m) * now[voxel].axes[axis];
    }
    const double share = 1.0 / static_cast<double>(voxels.size());
    points[axis][meshes::is_max(side) ? 1 : 0] = {share * sum.x, share * sum.y, share * sum.z};
  }
  return points;
}

double SettledBody::volume_change(const Voxels& now, const voxel::DrivenSizes& sizes) const {
  const double at_rest_m3 = std::pow(body_.edge_m, 3);
  double chambers_m3 = 0.0;
  double growth_m3 = 0.0;
  for (std::size_t voxel = 0; voxel < voxel_count(); ++voxel) {
    std::array<double, 3> length{};
    std::array<double, 3> bulge{};
    for (const Side side : meshes::all_sides) {
      length[meshes::axis_of(side)] += half_length_m(voxel, side, now, sizes);
      bulge[meshes::axis_of(side)] += bulge_m(voxel, side, sizes);
    }
    growth_m3 += length[0] * length[1] * length[2] + bulge[0] * length[1] * length[2] + length[0] * bulge[1] * length[2] +
                 length[0] * length[1] * bulge[2] - at_rest_m3;
    chambers_m3 += at_rest_m3 - body_.voxels.wall_volume_m3[voxel];
  }
  return growth_m3 / chambers_m3;
}

double SettledBody::observed(TradeObservable observable, const Voxels& now, double pressure_Pa) const {
  assert(now.size() == voxel_count());
  const voxel::DrivenSizes driven = sizes(pressure_Pa);
  if (observable == TradeObservable::volume_change) return volume_change(now, driven);
  Voxels rest;
  for (std::size_t voxel = 0; voxel < voxel_count(); ++voxel)
    rest.push_back({body_.rest[voxel].position, {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}});
  const materials::EndPoints before = ends(rest, sizes(0.0));
  const std::size_t axis = axis_of(observable);
  return materials::extents_without_rotation(before, ends(now, driven)).at(axis) - body_.box_m.at(axis);
}

std::map<fs::path, SettledBody> settled_bodies(const TradeStudy& study) {
  std::map<fs::path, SettledBody> bodies;
  if (!study.settling) return bodies;
  std::map<int, fs::path> files;
  for (const fs::path& file : study.settling->parameters) {
    const SettledBody& body = bodies.emplace(file, SettledBody(study, file)).first->second;
    const auto [other, is_new] = files.emplace(body.voxels_per_cell(), file);
    if (is_new) continue;
    throw io::InputError(file.string() + ": holds_for.voxels_per_cell = " + std::to_string(body.voxels_per_cell()) + ": so has " +
                         other->second.string() + ", settling.parameters takes one file for each");
  }
  return bodies;
}

}  // namespace menger::evolution
