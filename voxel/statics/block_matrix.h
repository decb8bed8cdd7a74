#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <vector>

namespace menger::voxel {

/// A sparse matrix of 6 x 6 blocks. Its pattern is set once, and values are added many times.
class BlockMatrix {
 public:
  /// Position of a block in the array of values, and the distance between its columns there.
  struct Place {
    Eigen::Index start = 0;
    Eigen::Index stride = 0;
  };

  /// @param size blocks per side @param blocks {row, column} of blocks that may hold values; diagonal blocks always may
  BlockMatrix(std::size_t size, const std::vector<std::array<std::size_t, 2>>& blocks);

  /// The position of a block of the pattern.
  [[nodiscard]] Place place(std::size_t row, std::size_t column) const;

  void set_zero();

  /// Adds values to a block, from position (row, column) within it.
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
