#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace menger::meshes {

/// The kinds of load that are applied to a body. "Base" and "tip" are the planes of its bounding box with the least and largest
/// x. A plate is bonded to all faces that lie in such a plane and moves as a rigid body. z points up.
enum class LoadCaseKind {
  inflation,  ///< free body (only rigid motions are held); driven by `pressures_Pa`
  blocked,    ///< base and tip plates fixed; driven by `pressures_Pa`
  stretch,    ///< tip plate moves along +x by `imposed` (m)
  shear,      ///< tip plate moves along +z by `imposed` (m) without turning
  bending,    ///< tip plate turns by `imposed` (rad) about +y; its centre follows the circular arc of a bar of constant length
              ///< whose middle line bends down: x = l sin(a) / a - l, z = -l (1 - cos(a)) / a
  torsion,    ///< tip plate turns by `imposed` (rad) about the body's x axis, and stays where it is
  press,      ///< plate on the top (largest z) moves down by `imposed` (m); rigid frictionless ground under the body
  sag,        ///< base plate fixed, gravity grows to `imposed` times 9.80665 m/s^2, tip free
  modes       ///< base plate fixed, small vibrations about the state under each pressure
};

std::string_view to_string(LoadCaseKind kind);

/// A load case on one hollow body, fully stated: equal load cases have equal responses.
///
/// Except for inflation, blocked and modes, every pressure is combined with every imposed value, in that order.
struct LoadCase {
  std::string name;  ///< name of the case: letters, digits, "-" and "_"
  LoadCaseKind kind = LoadCaseKind::inflation;
  std::array<int, 3> cells{1, 1, 1};  ///< size of the grid of the basal design
  std::string digits = "1";           ///< a digit 0, 1 or 2 for each of its cells, x fastest, then y, then z
  int level = 1;
  bool per_phase = false;  ///< chambers per phase instead of one chamber per module
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
  std::vector<double> pressures_Pa{};  ///< gauge pressure, the same in all chambers
  std::vector<double> imposed{};

  bool operator==(const LoadCase&) const = default;
};

/// The box around the occupied cells of a basal body.
struct CellBox {
  std::array<int, 3> lowest{};
  std::array<int, 3> size{};  ///< cells along x, y and z; 0 without an occupied cell
};

/// Returns the box around the occupied cells of a grid.
/// @param cells size of the grid, each >= 1
/// @param digits digits of the cells as in LoadCase, one for each cell
CellBox occupied_box(const std::array<int, 3>& cells, std::string_view digits);

/// Returns x, y and z of the occupied cells, ascending by z, then y, then x.
/// @param cells size of the grid, each >= 1
/// @param digits digits of the cells as in LoadCase, one for each cell
std::vector<std::array<int, 3>> occupied_cells(const std::array<int, 3>& cells, std::string_view digits);

/// Returns the number of cells along the longest side of the box around the occupied cells of a basal body. A range of validity
/// uses this length. The level does not count, because modules are separate hollow bodies; see longest_side_modules.
/// @param cells size of the grid, each >= 1
/// @param digits digits of the cells as in LoadCase, one for each cell
int longest_side_cells(const std::array<int, 3>& cells, std::string_view digits);

/// Returns the number of modules along the longest side of the fractal of a basal body: cells^(level - 1), 1 for a single module.
/// If an int cannot hold it, returns the largest int.
/// @param longest_side_cells of the basal body, >= 1
/// @param level >= 1
int longest_side_modules(int longest_side_cells, int level);

/// Returns the columns of the response curve of a kind, abscissae first. Units are in the names:
/// - pressure_Pa; imposed displacement_m, angle_rad or gravity_factor
/// - force_N, moment_N_m: from the tip plate on the body, along the imposed motion: along +x (blocked: negative while the body
///   pushes outwards), along +z, about +y, about +x; for press: the upward force of the ground
/// - volume_change: volume of all chambers divided by their volume at rest, minus 1
/// - extent_x_m, extent_y_m, extent_z_m: growth of the distance between the mean positions of the two end faces of an axis (mean
///   over the area of the faces that, at rest, lie in the planes of the bounding box)
/// - top_m: growth of the height of the middle of the top (meshes/load_cases/body_top.h) above the mean of the bottom faces
/// - tip_m: mean displacement of the tip faces along z (sag)
/// - frequency_1_Hz ... frequency_3_Hz (modes), ascending
///
/// For inflation, the rotation of the body is removed from extents and top (meshes/load_cases/body_extents.h), because a body
/// that is not symmetric turns about whatever holds its rigid motions.
///
/// Columns by kind:
/// - inflation: pressure, volume_change, the extents, top
/// - blocked: pressure, force, volume_change
/// - stretch: pressure, displacement, force, volume_change, extents in y and z
/// - shear and press: pressure, displacement, force
/// - bending and torsion: pressure, angle, moment
/// - sag: pressure, gravity_factor, tip
/// - modes: pressure, frequencies
///
/// A body that stands on several feet has more columns for its inflation, see the other overload.
std::vector<std::string> response_columns(LoadCaseKind kind);

/// Returns the columns of the response curve of a load case. They are those of its kind. The inflation of a single module that
/// stands on two feet or more also has foot_1_out_m, foot_2_out_m, ...: how far each foot moves away from the middle of all feet
/// (meshes/load_cases/body_feet.h).
std::vector<std::string> response_columns(const LoadCase& load_case);

/// Returns how many of these columns, from the left, are abscissae.
std::size_t abscissa_count(LoadCaseKind kind);

}  // namespace menger::meshes
