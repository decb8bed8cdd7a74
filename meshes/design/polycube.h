#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace menger::meshes {

/// The material of a cell of a polycube; 0 is empty.
using Material = std::uint8_t;
inline constexpr Material empty = 0;
inline constexpr Material largest_material = 2;

/// Position of a cell in its grid, in cells; z points up.
struct CellIndex {
  int x = 0;
  int y = 0;
  int z = 0;
  auto operator<=>(const CellIndex&) const = default;
};

/// A body of equal cubes on a regular grid. Every cell is empty or of material 1 or 2.
class Polycube {
 public:
  Polycube() = default;

  /// Makes an empty grid of nx * ny * nz cells, each number at least 1. @throws std::invalid_argument otherwise
  Polycube(int nx, int ny, int nz);

  /// Makes a grid from digits 0, 1, 2, x fastest, then y, then z: the digit of cell (x, y, z) is at x + nx (y + ny z).
  /// @throws std::invalid_argument if the number of digits is not nx ny nz or one is not 0, 1 or 2
  static Polycube from_digits(int nx, int ny, int nz, const std::string& digits);

  [[nodiscard]] int nx() const { return size_[0]; }
  [[nodiscard]] int ny() const { return size_[1]; }
  [[nodiscard]] int nz() const { return size_[2]; }

  [[nodiscard]] bool contains(const CellIndex& cell) const {
    return cell.x >= 0 && cell.x < size_[0] && cell.y >= 0 && cell.y < size_[1] && cell.z >= 0 && cell.z < size_[2];
  }

  /// Returns the material of a cell. The cell must be inside the grid (asserted).
  [[nodiscard]] Material at(const CellIndex& cell) const;
  void set(const CellIndex& cell, Material material);

  /// Returns the material of a cell; `empty` outside the grid.
  [[nodiscard]] Material at_or_empty(const CellIndex& cell) const { return contains(cell) ? at(cell) : empty; }

  /// Returns the number of cells that are not empty.
  [[nodiscard]] std::size_t count() const;

  /// Returns all occupied cells in grid order (x fastest, then y, then z).
  [[nodiscard]] std::vector<CellIndex> occupied() const;

  /// Returns the digits of all cells in grid order. It is the inverse of from_digits.
  [[nodiscard]] std::string digits() const;

  bool operator==(const Polycube&) const = default;

 private:
  [[nodiscard]] std::size_t offset(const CellIndex& cell) const;

  std::array<int, 3> size_{0, 0, 0};
  std::vector<Material> cells_;
};

}  // namespace menger::meshes
