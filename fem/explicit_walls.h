#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fem/wall_contact.h"
#include "meshes/hexahedral_mesh.h"

namespace menger::fem {

/// Where walls of one chamber are nearest to each other, or deepest in each other.
struct ChamberGap {
  std::size_t chamber;
  WallGap gap;  ///< its faces are counted within the chamber
};

/// Watches the walls of each chamber for contact with each other. Walls of different chambers and the outside of the body are not
/// looked at.
class ExplicitWalls {
 public:
  explicit ExplicitWalls(const meshes::HexahedralMesh& mesh);

  /// The smallest gap of all chambers; nothing if none is smaller than reach_m(). Crossings are seen up to half of the shortest
  /// edge deep. @param positions_m current, 3 per node, finite
  [[nodiscard]] std::optional<ChamberGap> smallest_gap(std::span<const double> positions_m) const;

  /// Gaps beyond it are not looked for, m: four of the shortest edges.
  [[nodiscard]] double reach_m() const { return 4.0 * shortest_edge_; }

  /// The largest way of a wall's node between two states, m, apart from the mean motion of the nodes of its chamber.
  [[nodiscard]] double travel_m(std::span<const double> from_m, std::span<const double> to_m) const;

  /// How far walls may travel until gaps are looked at again, m, so that walls a gap apart cross by half an edge at most.
  [[nodiscard]] double allowed_travel_m(const std::optional<ChamberGap>& gap) const;

 private:
  struct Walls {
    std::vector<std::size_t> nodes;                 ///< of the mesh
    std::vector<std::array<std::size_t, 4>> faces;  ///< of these, ordered as in FaceNodes
  };
  std::vector<Walls> chambers_;
  double shortest_edge_;  ///< of the chambers' faces at rest; infinite without chambers
};

}  // namespace menger::fem
