#include "evolution/trade_off/trade_off_settled.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "evolution/trade_off/trade_off_body.h"
#include "evolution/trade_off/trade_off_voxels.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/statics/body_shape.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using voxel::Vector3;

/// Checks that the parameters of a file hold for the study's body. @throws io::InputError if not
void require_subject(const TradeStudy& study, const voxel::SurrogateParameters& parameters, const fs::path& file) {
  const auto refuse = [&](const std::string& key, const std::string& value, const std::string& wanted) {
    throw io::InputError(file.string() + ": holds_for." + key + " = " + value + ": " + study.file.string() + " has " + wanted);
  };
  const auto require_text = [&](const std::string& key, const std::string& value, const std::string& wanted) {
    if (value != wanted) refuse(key, io::toml_quoted(value), io::toml_quoted(wanted));
  };
  const auto require_length = [&](const std::string& key, double value, double wanted) {
    constexpr double rounding = 1e-9;  // files may write the same length with other digits
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

/// Returns the rotation that turns x, y, z into three directions.
voxel::Quaternion<double> orientation_of(const std::array<Vector3<double>, 3>& axes) {
  Eigen::Matrix3d rotation;
  for (Eigen::Index column = 0; column < 3; ++column) {
    const Vector3<double>& axis = axes.at(static_cast<std::size_t>(column));
    rotation.col(column) << axis.x, axis.y, axis.z;
  }
  const Eigen::Quaterniond q(rotation);
  return {q.w(), q.x(), q.y(), q.z()};
}

/// Largest change of an observable over the last tenth of a run that has settled, relative to its error_scales.
constexpr double still = 1e-3;

using Corners = std::array<Vector3<double>, 8>;

/// Returns the mean of four corners of a cube.
Vector3<double> face(const Corners& corners, const std::array<std::size_t, 4>& of) {
  return 0.25 * (corners.at(of[0]) + corners.at(of[1]) + corners.at(of[2]) + corners.at(of[3]));
}

/// Returns the direction from one point to another, of length one.
Vector3<double> direction(const Vector3<double>& from, const Vector3<double>& to) {
  const Vector3<double> across = to - from;
  return 1.0 / std::sqrt(dot(across, across)) * across;
}

/// Returns the directions of a voxel's axes from the box that is drawn for it. The box does not give the position of the voxel:
/// it is larger on sides that bulge.
/// @param corners in the order of VTK_HEXAHEDRON
std::array<Vector3<double>, 3> directions(const Corners& corners) {
  return {direction(face(corners, {0, 3, 4, 7}), face(corners, {1, 2, 5, 6})),
          direction(face(corners, {0, 1, 4, 5}), face(corners, {2, 3, 6, 7})),
          direction(face(corners, {0, 1, 2, 3}), face(corners, {4, 5, 6, 7}))};
}

/// Describes for people how an observable is still changing. @param before, value its values before and after the last tenth of
/// the run
std::string moving_text(TradeObservable observable, double before, double value) {
  return "still moving: " + column_of(observable) + " changed from " + io::number_text(before) + " to " + io::number_text(value) +
         " in the last tenth of the time";
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
    throw io::InputError(file.string() + ": holds_for.voxels_per_cell = " + std::to_string(body.voxels_per_cell()) + ": as in " +
                         other->second.string() + "; settling.parameters may have one file per number of voxels per cell");
  }
  return bodies;
}

SettledBody::Voxels frame_voxels(const fs::path& file) {
  if (!io::is_file(file)) throw io::InputError(file.string() + ": there is no such file");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  vtkDataArray* centres = grid.GetCellData()->GetArray("centre_m");
  if (centres == nullptr || centres->GetNumberOfComponents() != 3)
    throw io::InputError(file.string() + ": is not a frame of menger simulate: centre_m is missing");
  SettledBody::Voxels voxels;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    grid.GetCellPoints(cell, ids);
    Corners corners{};
    if (ids->GetNumberOfIds() != static_cast<vtkIdType>(corners.size()))
      throw io::InputError(file.string() + ": cell " + std::to_string(cell) + " is not a cube");
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      std::array<double, 3> point{};
      grid.GetPoint(ids->GetId(static_cast<vtkIdType>(corner)), point.data());
      corners[corner] = {point[0], point[1], point[2]};
    }
    std::array<double, 3> centre{};
    centres->GetTuple(cell, centre.data());
    voxels.push_back({.middle = {centre[0], centre[1], centre[2]}, .axes = directions(corners)});
  }
  return voxels;
}

void read_settling_result(const TradeStudy& study, const SettledBody& body, double pressure_Pa,
                          const io::ProgramJobResult& result, TradeRow& row) {
  if (!read_voxel_summary(result, row)) return;
  std::vector<fs::path> frames;
  for (const fs::directory_entry& entry : fs::directory_iterator(result.folder / "result/frames")) frames.push_back(entry.path());
  std::ranges::sort(frames);
  if (frames.size() < 3) throw io::InputError(result.folder.string() + ": holds too few frames");
  const SettledBody::Voxels before = frame_voxels(frames[frames.size() - 2]);
  const SettledBody::Voxels settled = frame_voxels(frames.back());
  for (const auto* voxels : {&before, &settled}) {
    if (voxels->size() != body.voxel_count())
      throw io::InputError(result.folder.string() + ": the frames have another number of voxels than the body");
  }
  std::vector<std::string> columns;
  for (std::size_t n = 0; n < study.observables.size(); ++n) {
    row.values[n] = body.observed(study.observables[n], settled, pressure_Pa);
    columns.push_back(column_of(study.observables[n]));
  }
  const std::vector<double> scales = error_scales(columns, row.values);
  for (std::size_t n = 0; n < study.observables.size(); ++n) {
    const double earlier = body.observed(study.observables[n], before, pressure_Pa);
    if (std::abs(*row.values[n] - earlier) <= still * scales[n]) continue;
    row.reason += (row.reason.empty() ? "" : "; ") + moving_text(study.observables[n], earlier, *row.values[n]);
  }
}

}  // namespace menger::evolution
