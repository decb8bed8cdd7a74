#include "evolution/trade_off/trade_off_settled.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

#include "evolution/trade_off/trade_off_body.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/statics/body_shape.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
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

/// The rotation that takes x, y, z to three directions.
voxel::Quaternion<double> orientation_of(const std::array<Vector3<double>, 3>& axes) {
  Eigen::Matrix3d rotation;
  for (Eigen::Index column = 0; column < 3; ++column) {
    const Vector3<double>& axis = axes.at(static_cast<std::size_t>(column));
    rotation.col(column) << axis.x, axis.y, axis.z;
  }
  const Eigen::Quaterniond q(rotation);
  return {q.w(), q.x(), q.y(), q.z()};
}

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

double SettledBody::observed(TradeObservable observable, const Voxels& now, double pressure_Pa) const {
  assert(now.size() == voxel_count());
  const voxel::DrivenSizes driven = sizes(pressure_Pa);
  std::vector<voxel::Pose> poses;
  for (const OrientedVoxel& voxel : now) poses.push_back({voxel.middle, orientation_of(voxel.axes)});
  const voxel::BodyShape shape(body_, driven, poses);
  if (observable == TradeObservable::volume_change) return shape.chamber_volume_change();
  const std::size_t axis = axis_of(observable);
  return shape.free_size().extents.at(axis) - body_.box_m.at(axis);
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
