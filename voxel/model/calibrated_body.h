#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/design/polycube.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// What happens when a run leaves the range that its parameters were fitted on.
enum class OutsideRange {
  refuse,  ///< a scene that will leave the range is wrong input; a run whose strains leave it has diverged
  warn     ///< the run goes on, and its result carries a note
};

/// A body of hollow cells that is driven by the pressure in its chambers, in place of solid voxels that are driven by their size.
///
/// The pressure of a chamber with a phase (see Actuation) is mean + amplitude sin(2 pi (t / period + phase)) and varies between
/// the two values of pressure_Pa. With ActuationMode::hold it is always the higher one, with none it is zero. The ramp of the
/// drive multiplies each of them. The body stands on the feet of its walls (FootContact). Their friction needs no stop of
/// rotations.
struct CalibratedBody {
  SurrogateParameters parameters;
  std::array<double, 2> pressure_Pa{0.0, 0.0};  ///< lowest and highest, gauge
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;
  OutsideRange outside_range = OutsideRange::refuse;

  /// Level of the fractal that the body is; 1 is a single module. The code that builds the body sets it. It is not part of
  /// physics_text.
  int level = 1;

  bool operator==(const CalibratedBody&) const = default;
};

std::string_view to_string(OutsideRange rule);  ///< "refuse" or "warn"

/// Returns the voxels of a body of cells, with their walls.
/// @param body of level `calibrated.level`
/// @throws std::invalid_argument if the body is not the fractal of that level of any basal body
HollowVoxels calibrated_voxels(const meshes::Polycube& body, const CalibratedBody& calibrated);

/// Returns the basal body of a fractal.
/// @throws std::invalid_argument if `body` is not the fractal of `level` of any basal body
meshes::Polycube basal_body_of(const meshes::Polycube& body, int level);

/// Returns why the parameters cannot be used at all, or an empty text. Either they are for another cell edge, or walls have no
/// size (see sizeless_walls).
/// @param basal_body null: for any body; the walls are then a reason only if no wall class has a size
std::string unusable_parameters(const CalibratedBody& calibrated, double cell_edge_m,
                                const meshes::Polycube* basal_body = nullptr);

/// Returns which wall class of a body has no size at the pressures of its drive, or an empty text. A class has no size where its
/// law of extension or of bulge has no value at a pressure, or where the extension leaves no length.
std::string sizeless_walls(const CalibratedBody& calibrated, const meshes::Polycube& basal_body);

/// Returns one sentence for each wall class that has no size at the pressures of the drive, whether or not a body has that class.
std::vector<std::string> sizeless_walls(const CalibratedBody& calibrated);

/// Returns how a body and its drive lie outside the range of validity: one sentence for each fault, with both values. It compares
/// the pressures, by the walls and joints of the body (covered_pressures.h), the chambers, and along the longest side the cells
/// of a module and the number of modules.
std::vector<std::string> outside_validity(const CalibratedBody& calibrated, const meshes::Polycube& basal_body);

/// Returns how the drive lies outside the range of validity for bodies whose modules have at most `longest_body_cells` cells
/// along a side and may have any wall: one sentence for each fault.
/// @param longest_body_cells >= 1
std::vector<std::string> outside_validity(const CalibratedBody& calibrated, int longest_body_cells);

/// Returns why the chambers cannot be driven with these phases of the voxels, or an empty text. A chamber has one pressure, so
/// all its voxels must have the same phase.
std::string unrealisable_phases(const HollowVoxels& voxels, const std::vector<double>& phases);

}  // namespace menger::voxel
