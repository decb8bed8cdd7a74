#include "voxel/block_matrix.h"

#include <algorithm>
#include <cassert>

namespace menger::voxel {
namespace {

constexpr Eigen::Index block_size = 6;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

BlockMatrix::BlockMatrix(std::size_t size, const std::vector<std::array<std::size_t, 2>>& blocks)
    : rows_(size), matrix_(block_size * index(size), block_size * index(size)) {
  for (std::size_t i = 0; i < size; ++i) rows_[i].push_back(i);
  for (const auto& [row, column] : blocks) rows_[column].push_back(row);
  Eigen::VectorXi entries(block_size * index(size));
  for (std::size_t column = 0; column < size; ++column) {
    std::vector<std::size_t>& rows = rows_[column];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    entries.segment<block_size>(block_size * index(column)).setConstant(static_cast<int>(block_size * index(rows.size())));
  }
  matrix_.reserve(entries);
  for (std::size_t column = 0; column < size; ++column) {
    for (Eigen::Index j = 0; j < block_size; ++j) {
      for (const std::size_t row : rows_[column]) {
        for (Eigen::Index i = 0; i < block_size; ++i)
          matrix_.insert(block_size * index(row) + i, block_size * index(column) + j) = 0.0;
      }
    }
  }
  // Eigen reads past the end of a matrix of no columns: a single voxel that is held has none.
  if (matrix_.cols() > 0) matrix_.makeCompressed();
}

BlockMatrix::Place BlockMatrix::place(std::size_t row, std::size_t column) const {
  const std::vector<std::size_t>& rows = rows_[column];
  const auto found = std::lower_bound(rows.begin(), rows.end(), row);
  assert(found != rows.end() && *found == row);
  return {matrix_.outerIndexPtr()[block_size * index(column)] + block_size * (found - rows.begin()),
          block_size * index(rows.size())};
}

void BlockMatrix::set_zero() { std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0); }

}  // namespace menger::voxel
