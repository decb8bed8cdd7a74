#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "voxel/lattice.h"
#include "voxel/simulation.h"
#include "voxel/step_data.h"
#include "voxel/voxel_classes.h"

namespace menger::voxel {

template <class Real>
using AlignedArray = std::vector<Real, xsimd::aligned_allocator<Real, 64>>;

/// All arrays of a body in motion, and the pointers to them that the kernels take.
template <class Real>
class VoxelState {
 public:
  VoxelState(const Lattice& lattice, double cell_edge_m, const Physics& physics, const VoxelLoads& loads,
             const ClassTables& tables);
  VoxelState(const VoxelState&) = delete;
  VoxelState& operator=(const VoxelState&) = delete;

  StepData<Real> data;  ///< pointers into the arrays below

  [[nodiscard]] bool uniform() const { return uniform_; }
  [[nodiscard]] const std::vector<double>& phases() const { return phases_; }

  /// Puts the drive at sin and cos into all sizes and their rates; the kernels do this for the following steps.
  void set_sizes(double sine, double cosine);

 private:
  void allocate(const Lattice& lattice);
  void place_voxels(const Lattice& lattice, const Physics& physics, const VoxelLoads& loads, const ClassTables& tables);
  void fill_tables(const ClassTables& tables);
  void fill_beams(const Lattice& lattice);

  double edge_;
  std::size_t all_voxels_ = 0;  ///< with padding and the four ends of padding beams
  bool uniform_ = true;
  std::vector<double> phases_;
  AlignedArray<Real> pose_, motion_, load_, residual_, external_;
  AlignedArray<Real> size_base_, size_sine_, size_cosine_;
  AlignedArray<Real> voxel_table_, beam_table_;
  std::vector<std::int32_t> voxel_class_;
  std::array<std::vector<std::int32_t>, 3> lower_, upper_, beam_class_;
  std::array<AlignedArray<Real>, 3> history_;
};

}  // namespace menger::voxel
