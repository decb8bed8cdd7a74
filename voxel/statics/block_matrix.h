#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <vector>

namespace menger::voxel {

/// A sparse matrix of 6 x 6 blocks whose pattern is laid down once and whose values are added many times.
class BlockMatrix {
 public:
  /// Where a block begins in the values of the matrix, and how far its columns are apart.
  struct Place {
    Eigen::Index start = 0;
    Eigen::Index stride = 0;
  };

  /// @param size blocks per side @param blocks {row, column} of blocks that may hold values; those on the diagonal always may
  BlockMatrix(std::size_t size, const std::vector<std::array<std::size_t, 2>>& blocks);

  /// The place of a block of the pattern.
  [[nodiscard]] Place place(std::size_t row, std::size_t column) const;

  void set_zero();

  /// Adds values to the part of a block that begins at (row, column) in it.
  template <class Derived>
  void add(const Place& place, Eigen::Index row, Eigen::Index column, const Eigen::MatrixBase<Derived>& values) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      double* to = matrix_.valuePtr() + place.start + (column + j) * place.stride + row;
      for (Eigen::Index i = 0; i < values.rows(); ++i) to[i] += values(i, j);
    }
  }

  [[nodiscard]] const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  void fill_pattern();

  std::vector<std::vector<std::size_t>> rows_;  ///< by column: rows of its blocks, ascending
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace menger::voxel
