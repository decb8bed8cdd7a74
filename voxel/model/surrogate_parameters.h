#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "meshes/design/hollow_body_options.h"
#include "voxel/model/pressure_law.h"

namespace menger::voxel {

/// Which of the four sides of a voxel parallel to an axis carry a wall: the class of its half beams along the axis, and of its
/// faces across it. Two walls are three classes: facing each other they are the limb of a body; side by side the corner of a wide
/// one, where the voxel diagonally between the two open sides belongs to the same chamber, or else the bend of a limb, whose
/// faces span no further than a limb's. Where a cell has several voxels along an edge that voxel is part of the same cell, so
/// that no voxel is a bend.
///
/// How far a face bulges depends on how wide the plate is that it is part of: on the squares of four voxels that its voxel has in
/// common with open neighbours. An arm, which leads away one voxel wide, does not widen it. So the class of the bulge is that of
/// a voxel in a wide plate with as many squares, whatever arms there are beside: none with four squares or three, one with two,
/// corner with one. Without a square it is the class of the half beams, but bend, the nearest that any load case knows, where
/// three or four arms meet.
namespace walls {
enum WallClass : std::uint8_t { none, one, corner, bend, limb, three, closed };
}
inline constexpr std::size_t wall_class_count = 7;
inline constexpr std::size_t closed_wall_class = walls::closed;  ///< walls on all four sides
/// The names that files use, by position: walls on none, one, two adjacent (corner, bend), two opposite, three and four sides.
inline constexpr std::array<std::string_view, wall_class_count> wall_class_names{"0", "1", "2a", "2b", "2o", "3", "4"};
template <class Value>
using ByWallClass = std::array<Value, wall_class_count>;

/// Cells between two walls that face each other, told apart where they are few: one, two, three or more.
namespace gaps {
enum Gap : std::uint8_t { one_cell, two_cells, three_or_more_cells };
}
inline constexpr std::size_t gap_count = 3;
template <class Value>
using ByGap = std::array<Value, gap_count>;

/// The same value for every class.
constexpr ByWallClass<double> all_classes(double value) {
  ByWallClass<double> values{};
  values.fill(value);
  return values;
}

/// Factors on the stiffness of a beam that crosses from one module or chamber to another, where two walls are bonded.
struct JointFactors {
  double axial = 1.0;    ///< > 0
  double bending = 1.0;  ///< > 0
  double torsion = 1.0;  ///< > 0

  bool operator==(const JointFactors&) const = default;
};

/// What parameters were fitted on; outside it they say nothing.
///
/// Which pressures a body bears is decided by its widest wall, and that is what the class of a cell tells: the fewer walls it has
/// beside it, the wider the wall that it is part of. So every class has a range of its own, up to the pressures that any load
/// case reached with a body that has the class. Under vacuum a wall also needs room, the less the nearer the one that faces it:
/// every class has a range for each gap between the walls, up to what a load case reached across a gap at most as wide. Joints
/// are covered as far as a load case on a body with joints went. The range of a body, also of one of the fit, is the intersection
/// of those of all its classes, gaps and joints; see covered_pressures.h. Classes are those of cells, also where a cell has
/// several voxels.
struct ValidityRange {
  ByGap<ByWallClass<double>> lowest_pressure_Pa{};  ///< <= 0, by the gap that a cell lies in and its class, along the same axis
  ByWallClass<double> highest_pressure_Pa{};        ///< >= 0
  double lowest_joint_pressure_Pa = 0.0;            ///< <= 0
  double highest_joint_pressure_Pa = 0.0;           ///< >= 0
  double smallest_strain = 0.0;                     ///< of beams, axial, beyond the rest length
  double largest_strain = 0.0;
  int longest_body_cells = 0;         ///< see meshes::longest_side_cells, of the modules of the fit
  int longest_aggregate_modules = 1;  ///< see meshes::longest_side_modules, of the bodies of the fit; 1: single modules

  /// The same pressures for all walls and joints.
  void set_pressures(double lowest_Pa, double highest_Pa) {
    lowest_pressure_Pa.fill(all_classes(lowest_Pa));
    highest_pressure_Pa = all_classes(highest_Pa);
    lowest_joint_pressure_Pa = lowest_Pa;
    highest_joint_pressure_Pa = highest_Pa;
  }

  bool operator==(const ValidityRange&) const = default;
};

/// A hollow silicone cell as voxels and beams: what a calibration finds and a simulation uses.
///
/// A beam between voxels n and p along axis a consists of a half of each. A half of class c (see ByWallClass) has the section
/// stiffness EA = axial_Pa[c] L^2, EI = bending_Pa[c] L^4 / 12, GJ = torsion_Pa[c] L^4 / 12 with the voxel edge L, so that equal
/// moduli are the solid voxel of Voxelyze at Poisson's ratio 0, and the shear compliance 1 / (G A_s) = shear_compliance_per_Pa[c]
/// / L^2 (Timoshenko; at 0 sections stay normal to the axis, Euler-Bernoulli). The halves act in series: harmonic means of the
/// stiffnesses, the mean of the compliances. The joint factors multiply the stiffnesses where n and p belong to different
/// chambers, but not the shear compliance, which comes from the side walls over the whole length of the beam. The rest
/// length of a half is (L / 2)(1 + extension[c](p)), with p of its chamber, and longer where it leaves a plate (wall_openings).
/// Lateral coupling shortens the rest length of a beam by L c (e_b + e_d), e_b the mean over both ends of the voxel's strain
/// across the axis; see rest_lengths.h. A face with a wall lies (L / 2)(1 + extension) + L bulge[c](p) from the centre in the
/// mean over its area, L bulge_peak_ratio[c] bulge[c](p) where it stands out most; with that, its corners and its middle it meets
/// the ground (see WallFoot).
struct SurrogateParameters {
  // what they hold for
  std::string silicone;                                            ///< name of the record
  std::string law;                                                 ///< the law as one line of text, for comparison and for people
  double cell_edge_m = 0.0;                                        ///< > 0, of the cast cell
  double wall_thickness_m = 0.0;                                   ///< > 0
  int voxels_per_cell = 1;                                         ///< along an edge; L = cell_edge_m / voxels_per_cell
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;  ///< of the bodies of the fit
  ValidityRange validity;

  // the cell
  double density_kg_m3 = 0.0;                     ///< of the silicone, > 0; masses follow from the volume of the walls
  ByWallClass<double> axial_Pa{};                 ///< > 0
  ByWallClass<double> bending_Pa{};               ///< > 0
  ByWallClass<double> torsion_Pa{};               ///< > 0
  ByWallClass<double> shear_compliance_per_Pa{};  ///< >= 0; 0: Euler-Bernoulli
  JointFactors joint;
  double lateral_coupling = 0.0;  ///< c, 0 <= c < 1; a wide body contracts by c / (1 + c) of its strain
  ByWallClass<PressureLaw> extension{};
  ByWallClass<PressureLaw> bulge{};
  ByWallClass<double> bulge_peak_ratio = all_classes(1.0);  ///< largest bulge of a face by its mean, >= 1
  double ground_stiffness_N_per_m = 0.0;                    ///< > 0, of one voxel that stands on all feet of a wall
  double bond_damping_ratio = 1.0;                          ///< zeta, of beams, >= 0
  bool damping_measured = false;                            ///< false: the ratio is an assumption, no loss was measured

  [[nodiscard]] double voxel_edge_m() const { return cell_edge_m / voxels_per_cell; }
  bool operator==(const SurrogateParameters&) const = default;
};

}  // namespace menger::voxel
