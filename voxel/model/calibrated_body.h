#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/design/polycube.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// What happens where a run leaves the range that its parameters were fitted on.
enum class OutsideRange {
  refuse,  ///< a scene that will leave it is wrong input; a run whose strains leave it has diverged
  warn     ///< the run goes on, its result carries a note
};

/// Hollow cells driven by the pressure in their chambers, in place of solid voxels driven by their size.
///
/// With the phase of a chamber (Actuation) its pressure is mean + amplitude sin(2 pi (t / period + phase)) between the two
/// pressures; with ActuationMode::hold the higher one, always; with none zero; each times the ramp of the drive. It stands on the
/// feet of its walls (FootContact), whose friction needs no stop of rotations.
struct CalibratedBody {
  SurrogateParameters parameters;
  std::array<double, 2> pressure_Pa{0.0, 0.0};  ///< lowest and highest, gauge
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;
  OutsideRange outside_range = OutsideRange::refuse;

  /// Of the fractal that the body is; 1: a single module. Whoever builds the body knows it and sets it: it is no part of
  /// physics_text.
  int level = 1;

  bool operator==(const CalibratedBody&) const = default;
};

std::string_view to_string(OutsideRange rule);  ///< "refuse" or "warn"

/// The walls of a body of cells. @param body of level `calibrated.level`
/// @throws std::invalid_argument if the body is not the fractal of that level of any basal body
HollowVoxels calibrated_voxels(const meshes::Polycube& body, const CalibratedBody& calibrated);

/// The basal body of a fractal. @throws std::invalid_argument if `body` is not the fractal of `level` of any basal body
meshes::Polycube basal_body_of(const meshes::Polycube& body, int level);

/// Why the parameters cannot be used at all, or an empty text: another cell edge, walls without a size (see sizeless_walls).
/// @param basal_body null: for any body, one of a single wall class if need be
std::string unusable_parameters(const CalibratedBody& calibrated, double cell_edge_m,
                                const meshes::Polycube* basal_body = nullptr);

/// Which wall class of a body has no size under the pressures of its drive, because a law of it knows no value there or leaves
/// no length, or an empty text.
std::string sizeless_walls(const CalibratedBody& calibrated, const meshes::Polycube& basal_body);

/// The same of all wall classes that there are, a sentence each.
std::vector<std::string> sizeless_walls(const CalibratedBody& calibrated);

/// What of a body and its drive lies outside the range of validity, a sentence each with both numbers: pressures, by the walls
/// and joints that the body has (covered_pressures.h), chambers, and along the longest side the cells of a module and the
/// modules.
std::vector<std::string> outside_validity(const CalibratedBody& calibrated, const meshes::Polycube& basal_body);

/// The same of all bodies whose modules have at most so many cells along a side, and may have any wall.
/// @param longest_body_cells >= 1
std::vector<std::string> outside_validity(const CalibratedBody& calibrated, int longest_body_cells);

/// Why the chambers cannot be driven with these phases (of the voxels), or an empty text: a chamber has one pressure.
std::string unrealisable_phases(const HollowVoxels& voxels, const std::vector<double>& phases);

}  // namespace menger::voxel
