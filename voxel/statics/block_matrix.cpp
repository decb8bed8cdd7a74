#include "voxel/statics/block_matrix.h"

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
  for (std::size_t column = 0; column < size; ++column) {
    std::vector<std::size_t>& rows = rows_[column];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  }
  fill_pattern();
}

/// Fills the pattern directly in compressed form. To insert entries one by one would take longer than the use of the matrix.
void BlockMatrix::fill_pattern() {
  Eigen::Index count = 0;
  for (const auto& rows : rows_) count += block_size * block_size * index(rows.size());
  matrix_.resizeNonZeros(count);
  int* begin = matrix_.outerIndexPtr();
  int* row_of = matrix_.innerIndexPtr();
  Eigen::Index next = 0;
  for (std::size_t column = 0; column < rows_.size(); ++column) {
    for (Eigen::Index j = 0; j < block_size; ++j) {
      begin[block_size * index(column) + j] = static_cast<int>(next);
      for (const std::size_t row : rows_[column]) {
        for (Eigen::Index i = 0; i < block_size; ++i) row_of[next++] = static_cast<int>(block_size * index(row) + i);
      }
    }
  }
  begin[block_size * index(rows_.size())] = static_cast<int>(next);
  set_zero();
}

BlockMatrix::Place BlockMatrix::place(std::size_t row, std::size_t column) const {
  const std::vector<std::size_t>& rows = rows_[column];
  const auto found = std::lower_bound(rows.begin(), rows.end(), row);
  assert(found != rows.end() && *found == row);
  return {matrix_.outerIndexPtr()[block_size * index(column)] + block_size * (found - rows.begin()),
          block_size * index(rows.size())};
}

void BlockMatrix::set_zero() { matrix_.coeffs().setZero(); }

}  // namespace menger::voxel
