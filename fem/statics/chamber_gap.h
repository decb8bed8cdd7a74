#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fem/space/rank_gather.h"
#include "fem/space/space.h"
#include "fem/statics/body.h"
#include "fem/surfaces/wall_contact.h"

namespace menger::fem {

/// Finds the smallest gaps between the walls of the chambers of a body.
class ChamberGaps {
 public:
  /// Collects the chambers' faces of all ranks on the first rank.
  ChamberGaps(const Space& space, const Body& body);

  /// Returns the smallest gap of all chambers at given displacements (3 per local node), the same on all ranks; nothing if no two
  /// parts of a chamber's surface face each other.
  [[nodiscard]] std::optional<WallGap> smallest(std::span<const double> displacements) const;

  /// Diagonal of the largest bounding box of a chamber at rest, m; 0 without chambers.
  [[nodiscard]] double size_m() const { return size_m_; }

  /// The largest depth at which crossing walls are recognised, m: half the shortest edge of the chambers' faces.
  [[nodiscard]] double recognised_depth_m() const { return depth_m_; }

 private:
  [[nodiscard]] std::vector<Point> gather(std::span<const double> displacements) const;
  template <std::size_t n>
  [[nodiscard]] std::optional<WallGap> smallest_of(const std::vector<Point>& nodes) const;

  const Space& space_;
  std::vector<Index> own_nodes_;                                ///< local nodes of this rank's faces, as sent
  RankShares shares_;                                           ///< numbers of components per rank; first rank only
  std::vector<std::vector<std::array<std::size_t, 9>>> faces_;  ///< per chamber, indices into the gathered nodes; first rank only
  std::vector<std::size_t> first_of_;                           ///< gathered node -> the first one of the same global number
  double size_m_ = 0.0;
  double depth_m_ = 0.0;
};

}  // namespace menger::fem
