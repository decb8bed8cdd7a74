#include "meshes/design/polycube.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace menger::meshes {

namespace {

std::size_t cell_count(int nx, int ny, int nz) {
  if (nx < 1 || ny < 1 || nz < 1) throw std::invalid_argument("a polycube needs at least one cell along each axis");
  return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
}

}  // namespace

Polycube::Polycube(int nx, int ny, int nz) : size_{nx, ny, nz}, cells_(cell_count(nx, ny, nz), empty) {}

Polycube Polycube::from_digits(int nx, int ny, int nz, const std::string& digits) {
  if (digits.size() != cell_count(nx, ny, nz))
    throw std::invalid_argument("a polycube needs one digit per cell: " + std::to_string(digits.size()) + " for " +
                                std::to_string(cell_count(nx, ny, nz)) + " cells");
  Polycube body(nx, ny, nz);
  std::transform(digits.begin(), digits.end(), body.cells_.begin(), [](char digit) {
    if (digit < '0' || digit > '0' + largest_material) throw std::invalid_argument("the digits of a polycube are 0, 1 and 2");
    return static_cast<Material>(digit - '0');
  });
  return body;
}

Material Polycube::at(const CellIndex& cell) const { return cells_[offset(cell)]; }

void Polycube::set(const CellIndex& cell, Material material) {
  assert(material <= largest_material);
  cells_[offset(cell)] = material;
}

std::size_t Polycube::count() const {
  return cells_.size() - static_cast<std::size_t>(std::count(cells_.begin(), cells_.end(), empty));
}

std::vector<CellIndex> Polycube::occupied() const {
  std::vector<CellIndex> cells;
  cells.reserve(count());
  for (int z = 0; z < nz(); ++z) {
    for (int y = 0; y < ny(); ++y) {
      for (int x = 0; x < nx(); ++x) {
        const CellIndex cell{x, y, z};
        if (at(cell) != empty) cells.push_back(cell);
      }
    }
  }
  return cells;
}

std::string Polycube::digits() const {
  std::string text(cells_.size(), '0');
  std::transform(cells_.begin(), cells_.end(), text.begin(), [](Material material) { return static_cast<char>('0' + material); });
  return text;
}

std::size_t Polycube::offset(const CellIndex& cell) const {
  assert(contains(cell));
  const auto nx = static_cast<std::size_t>(size_[0]);
  const auto ny = static_cast<std::size_t>(size_[1]);
  return static_cast<std::size_t>(cell.x) + nx * (static_cast<std::size_t>(cell.y) + ny * static_cast<std::size_t>(cell.z));
}

}  // namespace menger::meshes
