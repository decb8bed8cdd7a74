#include "voxel/calibration/calibration_start.h"

#include <algorithm>

namespace menger::voxel {
namespace {

/// Mean deflection of a clamped square plate of edge b under p, divided by p b^4 / D. It is 0.00126 at the middle; for the shape
/// (1 + cos)(1 + cos) / 4 the mean is about a third of that.
constexpr double plate_factor = 4e-4;
constexpr double rough_peak_ratio = 2.5;

/// A voxel without walls has no stiffness. This fraction of the stiffness of a solid one keeps it in place.
constexpr double least_share = 0.02;

/// Bulge of a face divided by that of the closed cell. The deflection of a clamped plate grows with the fourth power of its span.
/// The span is the cell's chamber if it has walls around it, and 2 or 3 cells if it has one wall or none.
///
/// For half a cell the class is less specific, and the smallest span at which it occurs is taken: one cell with two walls, two
/// cells along one axis with one wall, two cells along both with none. For smaller parts, a closed cell alone has all classes.
ByWallClass<double> bulge_factors(int voxels_per_cell) {
  if (voxels_per_cell == 1) return {1000.0, 350.0, 50.0, 5.0, 3.3, 2.0, 1.0};
  if (voxels_per_cell == 2) return {50.0, 2.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  return all_classes(1.0);
}

/// Fraction of a voxel's section that is wall. @param t wall thickness / edge of the voxel
double wall_share(std::size_t wall_class, double t) {
  const double corner = (1.0 - t) * (1.0 - t);
  const double post = t * t;  // where the walls of the two limbs meet inside a bend
  const ByWallClass<double> air{
      1.0, 1.0 - t, corner, corner - post, 1.0 - 2.0 * t, (1.0 - t) * (1.0 - 2.0 * t), (1.0 - 2.0 * t) * (1.0 - 2.0 * t)};
  return 1.0 - air[wall_class];
}

}  // namespace

SurrogateParameters rough_parameters(const meshes::CurveProvenance& provenance, int voxels_per_cell) {
  const double a = provenance.load_case.cell_edge_m;
  const double t = provenance.load_case.wall_thickness_m;
  const double b = a - 2.0 * t;
  const double youngs_modulus_Pa = 3.0 * provenance.shear_modulus_Pa;
  const double plate_stiffness_N_m = youngs_modulus_Pa * t * t * t / 9.0;

  SurrogateParameters p;
  p.silicone = provenance.silicone;
  p.law = provenance.law;
  p.cell_edge_m = a;
  p.wall_thickness_m = t;
  p.voxels_per_cell = voxels_per_cell;
  p.density_kg_m3 = provenance.density_kg_m3;
  const double edge = p.voxel_edge_m();
  // Laws are relative to the edge of the voxel, and each voxel of a cell has the bulge of the cell.
  const ByWallClass<double> factors = bulge_factors(voxels_per_cell);
  const double bulge = plate_factor * b * b * b * b / (plate_stiffness_N_m * edge);
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    const double share = std::max(least_share, wall_share(c, std::min(t / edge, 0.5)));
    p.axial_Pa[c] = youngs_modulus_Pa * share;
    p.extension[c].slope_per_Pa = (1.0 - share) / (youngs_modulus_Pa * std::max(share, t / edge));
    p.bulge[c].slope_per_Pa = factors[c] * bulge;
  }
  p.bending_Pa = p.axial_Pa;
  p.torsion_Pa = p.axial_Pa;
  p.bulge_peak_ratio.fill(rough_peak_ratio);
  p.ground_stiffness_N_per_m = 2.0 * p.axial_Pa[closed_wall_class] * edge;
  return p;
}

}  // namespace menger::voxel
