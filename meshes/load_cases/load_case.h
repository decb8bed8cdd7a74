#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace menger::meshes {

/// What is done to a body to learn how it answers. "Base" and "tip" are the planes of its bounding box with the least and largest
/// x; a plate is bonded to all faces that lie in such a plane and moves as a rigid body. z points up.
enum class LoadCaseKind {
  inflation,  ///< free body (rigid motions held only); driven by `pressures_Pa`
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

/// One load case on one hollow body, in full: equal load cases have equal answers.
///
/// Except for inflation and blocked, every pressure is combined with every imposed value, in that order.
struct LoadCase {
  std::string name;  ///< of the case, letters, digits, "-" and "_"
  LoadCaseKind kind = LoadCaseKind::inflation;
  std::array<int, 3> cells{1, 1, 1};  ///< of the basal design
  std::string digits = "1";           ///< 0, 1, 2 of its cells, x fastest, then y, then z
  int level = 1;
  bool per_phase = false;  ///< chambers per phase instead of one chamber per module
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
  std::vector<double> pressures_Pa{};  ///< gauge, of all chambers together
  std::vector<double> imposed{};

  bool operator==(const LoadCase&) const = default;
};

/// The box around the occupied cells of a basal body.
struct CellBox {
  std::array<int, 3> lowest{};
  std::array<int, 3> size{};  ///< cells along x, y and z; 0 without an occupied cell
};

/// @param cells of the grid, each >= 1 @param digits of the cells as in LoadCase, as many as the grid has
CellBox occupied_box(const std::array<int, 3>& cells, std::string_view digits);

/// Cells along the longest side of the box around the occupied cells of a basal body: how long a body is that a range of validity
/// speaks of. Its level does not count, because modules are hollow bodies of their own; see longest_side_modules.
/// @param cells of the grid, each >= 1 @param digits of the cells as in LoadCase, as many as the grid has
int longest_side_cells(const std::array<int, 3>& cells, std::string_view digits);

/// Modules along the longest side of the fractal of a basal body: cells^(level - 1), 1 for a single module; what no int holds is
/// the largest one. @param longest_side_cells >= 1, of the basal body @param level >= 1
int longest_side_modules(int longest_side_cells, int level);

/// Columns of the response curve of a kind, abscissae first. Units are in the names:
/// - pressure_Pa; imposed displacement_m, angle_rad or gravity_factor
/// - force_N, moment_N_m: of the tip plate on the body along the imposed motion: along +x (blocked: negative while the body
/// pushes
///   out), +z, about +y, about +x; for press the ground's force upwards
/// - volume_change: of all chambers by their volume at rest, minus 1
/// - extent_x_m, extent_y_m, extent_z_m: growth of the distance between the mean positions of the end faces of the bounding box
///   across each axis (mean over the area of the faces that lie in those planes at rest)
/// - top_m: growth of the height of the middle of the body's top face ("top centre") over the mean of the bottom faces
///   Of inflation, extents and top are those after the rotation of the body is taken out (meshes/load_cases/body_extents.h): a
///   body that is not symmetric turns about whatever holds its rigid motions.
/// - tip_m: mean displacement of the tip faces along z (sag)
/// - frequency_1_Hz ... frequency_3_Hz (modes), ascending
///
/// inflation: pressure, volume_change, the extents, top; blocked: pressure, force, volume_change; stretch: pressure,
/// displacement, force, volume_change, extents in y and z; shear and press: pressure, displacement, force; bending and torsion:
/// pressure, angle, moment; sag: pressure, gravity_factor, tip; modes: pressure, frequencies.
std::vector<std::string> response_columns(LoadCaseKind kind);

/// How many of them, from the left, are abscissae.
std::size_t abscissa_count(LoadCaseKind kind);

}  // namespace menger::meshes
