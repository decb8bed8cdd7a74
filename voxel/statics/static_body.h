#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "meshes/design/side.h"
#include "voxel/laws/lattice.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/surrogate_parameters.h"
#include "voxel/model/wall_openings.h"
#include "voxel/statics/beam_tangent.h"

namespace menger::voxel {

/// A beam of a body at rest. It joins two voxels (its length is the voxel edge), or a voxel and a loading plate that holds its
/// face (half the edge).
struct StaticBeam {
  int axis = 0;
  std::size_t lower = 0;  ///< node: a voxel, or voxel count + index of a place
  std::size_t upper = 0;
  BeamCoefficients<double> coefficients{};
  AcrossBeam<double> elbow{};  ///< see elbow_turns; zero for a beam to a plate
};

/// A place where a plate holds the face of a voxel.
struct PlatePlace {
  std::size_t plate = 0;
  std::size_t voxel = 0;
};

/// A rigid plate, bonded to all faces of a body that lie in one plane of its bounding box.
struct Plate {
  meshes::Side side = meshes::Side::x_min;
  Vector3<double> centre{0.0, 0.0, 0.0};  ///< middle of that side of the bounding box, m
};

/// Half lengths of voxels and bulges of their walls under the pressures of their chambers.
struct DrivenSizes {
  std::vector<ByLawClass<double>> half_m;  ///< by chamber: (L / 2)(1 + extension)
  std::vector<ByLawClass<double>> bulge;   ///< by chamber, fraction of L
  std::vector<double> pressures_Pa;        ///< by chamber, gauge
};

/// A surrogate body at rest, with plates: all data of its equilibria and vibrations that do not depend on loads.
///
/// The lowest voxels stand on z = 0, and the bounding box of the body begins at the origin. Nodes are the voxels in grid order,
/// then the places on plates. Places of a plate keep their distances to each other.
struct StaticBody {
  StaticBody(const SurrogateParameters& body_parameters, HollowVoxels hollow, const std::vector<meshes::Side>& plate_sides);

  SurrogateParameters parameters;
  HollowVoxels voxels;
  Lattice lattice;
  double edge_m;                  ///< of a voxel, L
  std::array<double, 3> box_m{};  ///< size of the bounding box
  std::vector<StaticBeam> beams;  ///< along x, then y, then z, then those to plates
  std::vector<Plate> plates;
  std::vector<PlatePlace> places;
  std::vector<Pose> rest;       ///< of all nodes
  std::vector<double> mass_kg;  ///< of voxels
  std::vector<double> inertia_kg_m2;
  ByLawClass<bool> has_class{};  ///< whether any voxel has the class along any axis, for its length, its walls or its bulge
  std::vector<std::array<WallOpening, 6>> openings;
  /// Per voxel and side: the beam that leaves the voxel there, if any.
  std::vector<std::array<std::optional<std::size_t>, 6>> beam_at;

  [[nodiscard]] std::size_t voxel_count() const { return lattice.voxel_count(); }
  [[nodiscard]] bool is_voxel(std::size_t node) const { return node < voxel_count(); }

  /// Voxels whose face on a side lies in that plane of the bounding box.
  [[nodiscard]] std::vector<std::size_t> end_voxels(meshes::Side side) const;

  /// Length of a voxel from its centre to a side (-x, +x, -y, ...), without lateral coupling, m.
  [[nodiscard]] double half_length(const DrivenSizes& sizes, std::size_t voxel, std::size_t side) const {
    return sizes.half_m[voxels.chamber[voxel]][voxels.half_class[voxel][side]];
  }
  /// Half lengths of a voxel along x, y, z for its feet, m.
  [[nodiscard]] std::array<double, 3> foot_half_lengths(const DrivenSizes& sizes, std::size_t voxel) const {
    const auto& half_m = sizes.half_m[voxels.chamber[voxel]];
    const auto& of_axes = voxels.size_class[voxel];
    return {half_m[of_axes[0]], half_m[of_axes[1]], half_m[of_axes[2]]};
  }
  /// Rest length of a beam, without lateral coupling, m.
  [[nodiscard]] double rest_length(const DrivenSizes& sizes, const StaticBeam& beam) const;
  /// Half the kink of a beam, see kink in beam.h, rad.
  [[nodiscard]] AcrossBeam<double> half_kink(const DrivenSizes& sizes, const StaticBeam& beam) const;
  /// The sum over the wall classes of shares of the heights at an opening, see WallOpening, as a fraction of L.
  [[nodiscard]] double crown_sum(const DrivenSizes& sizes, std::size_t voxel, const ByLawClass<double>& shares) const;
  /// Mean bulge of a wall of a voxel across an axis, m.
  [[nodiscard]] double bulge(const DrivenSizes& sizes, std::size_t voxel, std::size_t axis) const {
    return edge_m * sizes.bulge[voxels.chamber[voxel]][voxels.bulge_class[voxel][axis]];
  }
};

/// Sizes of voxels under gauge pressures (Pa), one per chamber, for the classes that a body has. Returns nothing if the law
/// of such a class reaches its pole, or if a half length falls below a tenth of its value at rest: such a body has no usable
/// size.
std::optional<DrivenSizes> driven_sizes(const StaticBody& body, const std::vector<double>& pressures_Pa);

}  // namespace menger::voxel
