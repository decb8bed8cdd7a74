#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "meshes/design/modular_body.h"
#include "meshes/design/polycube.h"

namespace menger::voxel {

/// The voxels of one chamber of a body.
class ChamberVoxels {
 public:
  /// @param cell any cell of the chamber; the body must outlive this object
  /// @param parts voxels along the edge of a cell
  ChamberVoxels(const meshes::ModularBody& body, const meshes::CellIndex& cell, int parts);

  /// Whether a voxel, which may lie outside the grid, is one of them.
  [[nodiscard]] bool contains(const meshes::CellIndex& voxel) const;
  /// Whether the three voxels that form a square with a voxel, towards two sides, are among them.
  [[nodiscard]] bool has_square(const meshes::CellIndex& voxel, meshes::Side first, meshes::Side second) const;
  /// Whether a voxel has walls on both sides along an axis.
  [[nodiscard]] bool is_between_walls(const meshes::CellIndex& voxel, std::size_t axis) const;

 private:
  const meshes::ModularBody* body_;
  std::size_t region_;
  int parts_;
};

/// What decides how a voxel of a hollow body lengthens and bulges, see WallClass and LawClass.
struct VoxelClasses {
  std::array<std::uint8_t, 3> wall{};  ///< wall class, per axis
  std::array<std::uint8_t, 6> half{};  ///< law class of the half on each side (-x, +x, -y, ...)
  /// Law class of both halves along each axis. Where only one of them lies in a plate it is the wall class; where both do, with
  /// different laws, that of the half that is drawn in less.
  std::array<std::uint8_t, 3> size{};
  std::array<std::uint8_t, 3> bulge{};  ///< law class of the faces across each axis
};

/// Returns the classes of a voxel of a chamber.
[[nodiscard]] VoxelClasses classes_of_voxel(const ChamberVoxels& chamber, const meshes::CellIndex& voxel);

}  // namespace menger::voxel
