#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fem/space/space.h"
#include "fem/statics/body.h"
#include "fem/thin_walls/wall_volume.h"

namespace menger::fem {

/// A thin wall with a chamber on one side or on both.
struct PressedWall {
  std::size_t element = 0;  ///< local
  std::size_t normal = 2;
  std::array<double, 3> edges_m{};
  std::array<int, 2> plena{-1, -1};     ///< behind the lower and the upper face along the normal; -1: the outside
  std::array<int, 2> chambers{-1, -1};  ///< likewise
  double shear_bulge_m3_per_Pa = 0.0;   ///< see wall_shear_bulge
};

/// The walls of a rank that chambers press on; none in bodies of other elements.
///
/// Such a wall does two things to the volume of a chamber.
/// - Work: half of its change of volume counts as the chamber's (see wall_volume_change). This part is no air and is not
/// reported.
/// - Reading: nodes lie too far apart to show how walls bend between them, and bilinear faces miss a fifth of the growth of
/// narrow
///   chambers. Reported volumes contain these bulges (see wall_bulge); forces do not.
class PressedWalls {
 public:
  PressedWalls(const Space& space, const Body& body);

  [[nodiscard]] const std::vector<PressedWall>& walls() const { return walls_; }

  /// Sign of a bulge along the normal for the volume of the chamber behind the lower (0) or upper (1) face.
  [[nodiscard]] static double sign(std::size_t side) { return side == 0 ? 1.0 : -1.0; }

  /// Adds the bulges of this rank's walls to the volumes of chambers.
  void add_bulges(std::span<const double> displacements_m, std::span<const double> plenum_pressures_Pa,
                  std::span<double> chamber_volumes_m3) const;

  /// How much of the bulges' volume in a plenum a pressure in another (or the same) adds, m^3/Pa; of all ranks.
  [[nodiscard]] double volume_by_pressure(std::size_t plenum, std::size_t pressed) const {
    return volume_by_pressure_.empty() ? 0.0 : volume_by_pressure_[plenum * plenum_count_ + pressed];
  }

 private:
  const Space& space_;
  std::size_t plenum_count_;
  std::vector<PressedWall> walls_;
  std::vector<double> volume_by_pressure_;  ///< empty without thin walls
};

}  // namespace menger::fem
