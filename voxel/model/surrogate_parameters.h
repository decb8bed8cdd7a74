#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "meshes/design/hollow_body_options.h"
#include "voxel/model/pressure_law.h"
#include "voxel/model/wall_classes.h"

namespace menger::voxel {

/// Factors on the stiffness of a beam that crosses from one module or chamber to another, where two walls are bonded.
struct JointFactors {
  double axial = 1.0;    ///< > 0
  double bending = 1.0;  ///< > 0
  double torsion = 1.0;  ///< > 0

  bool operator==(const JointFactors&) const = default;
};

/// The range of validity: what the parameters were fitted on. They must not be trusted outside it.
///
/// The widest wall of a body decides which pressures the body bears. The class of a cell shows how wide its wall is: the fewer
/// walls a cell has beside it, the wider is the wall that it is part of. So every class has a range of its own, up to the
/// pressures that any load case reached with a body that has the class.
///
/// Under vacuum a wall also needs room, and the nearer the facing wall, the less room there is. So every class has a range for
/// each gap between the walls, up to what a load case reached across a gap at most as wide. Joints are covered as far as a load
/// case on a body with joints went.
///
/// The range of a body is the intersection of the ranges of all its classes, gaps and joints, also for a body of the fit; see
/// covered_pressures.h. Classes are those of cells, even where a cell has several voxels.
struct ValidityRange {
  ByGap<ByWallClass<double>> lowest_pressure_Pa{};  ///< <= 0, by the gap that a cell lies in and its class, along the same axis
  ByWallClass<double> highest_pressure_Pa{};        ///< >= 0
  double lowest_joint_pressure_Pa = 0.0;            ///< <= 0
  double highest_joint_pressure_Pa = 0.0;           ///< >= 0
  double smallest_strain = 0.0;                     ///< of beams, axial, relative to the rest length
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

/// The parameters of a hollow silicone cell as voxels and beams. A calibration finds them, a simulation uses them.
///
/// A beam along an axis between two voxels consists of a half of each. A half of class c (see ByWallClass) has the section
/// stiffness
///
///   EA = axial_Pa[c] L^2,  EI = bending_Pa[c] L^4 / 12,  GJ = torsion_Pa[c] L^4 / 12
///
/// with the voxel edge L. Equal moduli thus give the solid voxel of Voxelyze at Poisson's ratio 0. Its shear compliance is
/// 1 / (G A_s) = shear_compliance_per_Pa[c] / L^2 (Timoshenko; at 0 sections stay normal to the axis, Euler-Bernoulli).
///
/// The halves act in series: the beam has the harmonic means of the stiffnesses and the mean of the compliances. The joint
/// factors multiply the stiffnesses where the two voxels belong to different chambers. They leave the shear compliance as it is,
/// because it comes from the side walls over the whole length of the beam.
///
/// The rest length of a half is (L / 2)(1 + extension(p)), with the law extension_of its size class and the pressure p of its
/// chamber. It is longer where the half leaves a plate. The two halves are at an angle where it leaves the plate off its middle
/// (WallOpening), and at elbows (elbow_turns). Lateral coupling shortens the rest length of a beam along axis a by L c (e_b +
/// e_d). Here e_b and e_d are the strains along the two other axes b and d, each in the mean over the voxels at both ends; see
/// rest_lengths.h.
///
/// A face with a wall lies (L / 2)(1 + extension) + L bulge[c](p) from the centre in the mean over its area. Where it stands out
/// most, L bulge_peak_ratio[c] bulge[c](p) takes the place of the last term. The face meets the ground at that place, at its
/// corners and at its middle (see WallFoot).
struct SurrogateParameters {
  // what they hold for
  std::string silicone;           ///< name of the record
  std::string law;                ///< the law as one line of text, for comparison and for readers
  double cell_edge_m = 0.0;       ///< > 0, of the cast cell
  double wall_thickness_m = 0.0;  ///< > 0
  int voxels_per_cell = 1;        ///< along an edge; L = cell_edge_m / voxels_per_cell
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;  ///< of the bodies of the fit
  ValidityRange validity;

  // the cell
  double density_kg_m3 = 0.0;                     ///< of the silicone, > 0; masses follow from the volume of the walls
  ByWallClass<double> axial_Pa{};                 ///< > 0
  ByWallClass<double> bending_Pa{};               ///< > 0
  ByWallClass<double> torsion_Pa{};               ///< > 0
  ByWallClass<double> shear_compliance_per_Pa{};  ///< >= 0; 0: Euler-Bernoulli
  JointFactors joint;
  /// Turn of a beam at an elbow, rad, by the strain that pressure gives the beam; >= 0, see elbow_turns.
  double elbow_ratio = 0.0;
  double lateral_coupling = 0.0;  ///< c, 0 <= c < 1; a wide body contracts by c / (1 + c) of its strain
  /// Inside a plate, and at the inner edge of two, the law of extension has a slope r times as steep, and loses the draw-in d;
  /// the faces of a plate rise by g (see PressureLaw). At the edges of a plate, whose side walls resist, and beside arms a share
  /// e of this is left: r is 1 + e (r - 1), d is e d. The side of a plate rises by sqrt(e) g, its corner by e g. With each arm a
  /// face bulges a times as far.
  double plate_stretch_ratio = 1.0;   ///< r > 0
  double plate_draw_in = 0.0;         ///< 0 <= d < 1
  double plate_rise = 0.0;            ///< g >= 0, mean over a face, as a fraction of L
  double plate_draw_in_per_Pa = 0.0;  ///< h >= 0, of both
  double plate_edge_share = 0.0;      ///< 0 <= e <= 1
  double plate_arm_ratio = 1.0;       ///< a > 0
  /// Volume below the bulge of a face of a plate or a block, by the mean of the bulge times the area of the face; > 0. More than
  /// 1, because a wide wall is stretched most where it is highest.
  double wide_volume_ratio = 1.0;
  ByWallClass<PressureLaw> extension{};
  ByWallClass<PressureLaw> bulge{};
  ByWallClass<double> bulge_peak_ratio = all_classes(1.0);  ///< largest bulge of a face by its mean, >= 1
  /// How far a plate stands out at the corners of an opening from which a limb leaves, by the crown that would be there without
  /// the opening; > 0, see WallOpening.
  double neck_ratio = 1.0;
  double ground_stiffness_N_per_m = 0.0;  ///< > 0, of one voxel that stands on all feet of a wall
  double bond_damping_ratio = 1.0;        ///< zeta, of beams, >= 0
  bool damping_measured = false;          ///< false: the ratio is an assumption, no loss was measured

  [[nodiscard]] double voxel_edge_m() const { return cell_edge_m / voxels_per_cell; }
  /// Returns the law of extension of the beams of a law class.
  [[nodiscard]] PressureLaw extension_of(std::size_t law_class) const {
    PressureLaw changed = extension[wall_class_of(law_class)];
    if (!is_in_plate(law_class) || place_in_plate(law_class).is_face) return changed;
    const double share = std::pow(plate_edge_share, place_in_plate(law_class).edge_power);
    changed.slope_per_Pa *= 1.0 + share * (plate_stretch_ratio - 1.0);
    changed.arc = -share * plate_draw_in;
    changed.arc_per_Pa = plate_draw_in_per_Pa;
    return changed;
  }
  /// Returns the law of bulging of the faces of a law class.
  [[nodiscard]] PressureLaw bulge_of(std::size_t law_class) const {
    PressureLaw changed = bulge[wall_class_of(law_class)];
    if (!is_in_plate(law_class) || !place_in_plate(law_class).is_face) return changed;
    const double widened = std::pow(plate_arm_ratio, place_in_plate(law_class).arms);
    changed.slope_per_Pa *= widened;
    const double share = std::pow(plate_edge_share, place_in_plate(law_class).edge_power);
    changed.arc = widened * share * plate_rise;
    changed.arc_per_Pa = plate_draw_in_per_Pa;
    return changed;
  }
  /// Returns the volume below the bulge of a face of a law class, by the mean of the bulge times the area of the face.
  [[nodiscard]] double volume_ratio_of(std::size_t law_class) const {
    return wall_class_of(law_class) <= walls::corner ? wide_volume_ratio : 1.0;
  }
  /// Returns the largest bulge of a face of a law class, by its mean.
  [[nodiscard]] double bulge_peak_ratio_of(std::size_t law_class) const { return bulge_peak_ratio[wall_class_of(law_class)]; }
  bool operator==(const SurrogateParameters&) const = default;
};

}  // namespace menger::voxel
