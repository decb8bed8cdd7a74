#include "evolution/trade_off/trade_off_frames.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <system_error>
#include <vector>

#include "evolution/trade_off/trade_off_voxels.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr double still = 1e-3;  ///< change of an observable over the last tenth of a run that settled, by its error_scales

using Corners = std::array<voxel::Vector3<double>, 8>;

/// The mean of four corners of a cube.
voxel::Vector3<double> face(const Corners& corners, const std::array<std::size_t, 4>& of) {
  return 0.25 * (corners.at(of[0]) + corners.at(of[1]) + corners.at(of[2]) + corners.at(of[3]));
}

/// From one face of a cube to the one opposite, of length one.
voxel::Vector3<double> direction(const voxel::Vector3<double>& from, const voxel::Vector3<double>& to) {
  const voxel::Vector3<double> across = to - from;
  return 1.0 / std::sqrt(dot(across, across)) * across;
}

/// How a voxel is turned, by the box that is drawn for it. Where it is does not follow: the box reaches further on sides that
/// bulge.
/// @param corners in the order of VTK_HEXAHEDRON
std::array<voxel::Vector3<double>, 3> directions(const Corners& corners) {
  return {direction(face(corners, {0, 3, 4, 7}), face(corners, {1, 2, 5, 6})),
          direction(face(corners, {0, 1, 4, 5}), face(corners, {2, 3, 6, 7})),
          direction(face(corners, {0, 1, 2, 3}), face(corners, {4, 5, 6, 7}))};
}

/// What an observable is still doing, for people. @param before, value a tenth of the run apart, the later one last
std::string moving_text(TradeObservable observable, double before, double value) {
  return "still moving: " + column_of(observable) + " changed from " + io::number_text(before) + " to " + io::number_text(value) +
         " in the last tenth of the time";
}

}  // namespace

SettledBody::Voxels frame_voxels(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) throw io::InputError(file.string() + ": there is no such file");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  vtkDataArray* centres = grid.GetCellData()->GetArray("centre_m");
  if (centres == nullptr || centres->GetNumberOfComponents() != 3)
    throw io::InputError(file.string() + ": centre_m is missing: no frame of menger simulate");
  SettledBody::Voxels voxels;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    grid.GetCellPoints(cell, ids);
    Corners corners{};
    if (ids->GetNumberOfIds() != static_cast<vtkIdType>(corners.size()))
      throw io::InputError(file.string() + ": cell " + std::to_string(cell) + " is no cube");
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
    if (voxels->size() != body.voxel_count()) throw io::InputError(result.folder.string() + ": frames of another body");
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
