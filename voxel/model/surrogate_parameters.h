#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "meshes/design/hollow_body_options.h"
#include "voxel/model/pressure_law.h"

namespace menger::voxel {

/// The wall class of a voxel along an axis: which of its four sides parallel to the axis carry a wall. The stiffness of its half
/// beams along the axis follows from it, and their lengths outside plates (LawClass).
///
/// Two walls make three classes. Two walls that face each other are a limb of a body (`limb`). Two walls side by side are the
/// corner of a wide body (`corner`) if the voxel diagonally between the two open sides belongs to the same chamber. Otherwise
/// they are the bend of a limb (`bend`), whose faces span no further than those of a limb. Where a cell has several voxels along
/// an edge, this diagonal voxel is part of the same cell, so that no voxel is a `bend`.
///
/// The faces of a voxel across the axis have a class of their own, the bulge class. How far a face bulges depends on how wide its
/// plate is: on the number of squares of four voxels that its voxel forms with open neighbours. An arm, which leads away one
/// voxel wide, makes no square. So the bulge class is that of a voxel with as many squares in a wide plate without arms:
/// `none` for four or three squares, `one` for two, `corner` for one. Without a square it is the wall class. The exception is a
/// voxel without a square where three or four arms meet: it is `bend`, the nearest class that any load case contains.
namespace walls {
enum WallClass : std::uint8_t { none, one, corner, bend, limb, three, closed };
}
inline constexpr std::size_t wall_class_count = 7;
inline constexpr std::size_t closed_wall_class = walls::closed;  ///< walls on all four sides
/// The names of the classes in files, by position: walls on none, one, two adjacent (corner, bend), two opposite, three and four
/// sides.
inline constexpr std::array<std::string_view, wall_class_count> wall_class_names{"0", "1", "2a", "2b", "2o", "3", "4"};
inline constexpr std::array<std::string_view, wall_class_count> wall_class_meanings{
    "no wall beside them",
    "a wall on one side",
    "walls on two sides that meet, in a wide body",
    "walls on two sides that meet, at the bend of a limb",
    "walls on two opposite sides",
    "walls on three sides",
    "walls on all four sides"};
/// Returns a class as messages name it: "voxels with a wall on one side (wall class 1)".
inline std::string wall_class_text(std::size_t wall_class) {
  return "voxels with " + std::string(wall_class_meanings.at(wall_class)) + " (wall class " +
         std::string(wall_class_names.at(wall_class)) + ")";
}
template <class Value>
using ByWallClass = std::array<Value, wall_class_count>;

/// Which law a half of a voxel along an axis, or a face, follows: that of its wall class, or bulge class, but in plates. The
/// walls of a plate become arcs. So its edges are drawn in, and its faces rise further than those of a block.
///
/// Halves: `inside_plate` is walls::limb with an open square of four voxels on both sides of the half, `beside_arm` with one on
/// one side only, as where an arm leaves the plate or the plate has a notch. `plate_edge` is walls::three with a square on its
/// open side, `inner_edge` is walls::bend with squares on both, where two plates meet. Where limbs leave the plate in all these
/// squares beside the voxel, they hold it, and the half has its wall class. A plate that does not end there, but goes on round an
/// edge, does not hold it.
///
/// Faces, across each axis of a voxel: `middle_of_plate` if both axes along the face have halves in the plate, `side_of_plate` if
/// the axis does along which the plate goes on to both sides (so also where two squares meet at a corner), `corner_of_plate` if
/// both axes do. Faces of squares beside an edge round which a plate goes on are in it, too. An arm, which leaves the plate one
/// voxel wide, lets the face beside it rise further.
///
/// The order counts: halves come before faces, and faces go from the middle outwards.
enum LawClass : std::uint8_t {
  inside_plate = wall_class_count,
  plate_edge,
  beside_arm,
  inner_edge,
  middle_of_plate,  ///< of walls::none
  side_of_plate,    ///< of walls::one
  side_with_arm,
  corner_of_plate,  ///< of walls::corner
  corner_with_arm,
  corner_with_two_arms
};
inline constexpr std::size_t law_class_count = corner_with_two_arms + 1;
/// Returns the wall class of a law class.
constexpr std::size_t wall_class_of(std::size_t law_class) {
  constexpr std::array<std::size_t, law_class_count - wall_class_count> in_plates{
      walls::limb, walls::three, walls::limb,   walls::bend,   walls::none,
      walls::one,  walls::one,   walls::corner, walls::corner, walls::corner};
  return law_class < wall_class_count ? law_class : in_plates[law_class - wall_class_count];
}
/// Returns a law class as messages name it.
inline std::string law_class_text(std::size_t law_class) {
  constexpr std::array<std::string_view, law_class_count - wall_class_count> in_plates{"inside a plate",
                                                                                       "at the edge of a plate",
                                                                                       "in a plate beside an arm or a notch",
                                                                                       "at the inner edge of two plates",
                                                                                       "in the middle of a plate",
                                                                                       "at the side of a plate",
                                                                                       "at the side of a plate with an arm",
                                                                                       "in the corner of a plate",
                                                                                       "in the corner of a plate with an arm",
                                                                                       "in the corner of a plate with two arms"};
  return law_class < wall_class_count ? wall_class_text(law_class)
                                      : "voxels " + std::string(in_plates[law_class - wall_class_count]);
}
template <class Value>
using ByLawClass = std::array<Value, law_class_count>;

/// The number of cells between two walls that face each other: one, two, or three and more.
namespace gaps {
enum Gap : std::uint8_t { one_cell, two_cells, three_or_more_cells };
}
inline constexpr std::size_t gap_count = 3;
template <class Value>
using ByGap = std::array<Value, gap_count>;

/// Returns the same value for every class.
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
    PressureLaw of_class = extension[wall_class_of(law_class)];
    if (law_class < inside_plate || law_class > inner_edge) return of_class;
    const double share = law_class == inside_plate || law_class == inner_edge ? 1.0 : plate_edge_share;
    of_class.slope_per_Pa *= 1.0 + share * (plate_stretch_ratio - 1.0);
    of_class.arc = -share * plate_draw_in;
    of_class.arc_per_Pa = plate_draw_in_per_Pa;
    return of_class;
  }
  /// Returns the law of bulging of the faces of a law class.
  [[nodiscard]] PressureLaw bulge_of(std::size_t law_class) const {
    PressureLaw of_class = bulge[wall_class_of(law_class)];
    if (law_class < middle_of_plate) return of_class;
    const double at_side = law_class == middle_of_plate ? 1.0 : std::sqrt(plate_edge_share);
    of_class.arc = plate_rise * (law_class < corner_of_plate ? at_side : at_side * at_side);
    of_class.arc_per_Pa = plate_draw_in_per_Pa;
    const bool has_arm = law_class == side_with_arm || law_class >= corner_with_arm;
    const double widened = has_arm ? plate_arm_ratio * (law_class == corner_with_two_arms ? plate_arm_ratio : 1.0) : 1.0;
    of_class.slope_per_Pa *= widened;
    of_class.arc *= widened;
    return of_class;
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
