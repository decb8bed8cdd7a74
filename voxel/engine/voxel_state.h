#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "voxel/engine/voxel_body.h"
#include "voxel/engine/voxel_loads.h"
#include "voxel/kernels/step_data.h"
#include "voxel/model/actuation.h"

namespace menger::voxel {

template <class Real>
using AlignedArray = std::vector<Real, xsimd::aligned_allocator<Real, 64>>;

/// All arrays of a body in motion, and the pointers to them that the kernels take.
template <class Real>
class VoxelState {
 public:
  /// Beams of a calibrated body have rest lengths of their own, which start as the edge.
  VoxelState(const VoxelBody& body, const VoxelLoads& loads);
  VoxelState(const VoxelState&) = delete;
  VoxelState& operator=(const VoxelState&) = delete;

  StepData<Real> data;  ///< pointers into the arrays below

  /// Returns the origin that positions are counted from, m. It is the grid's corner, or in single precision, where digits are
  /// few, a place that is never far from the body.
  [[nodiscard]] const std::array<double, 3>& origin_m() const { return origin_; }

  /// Returns the centre of a voxel in the world, m, corrected for the rounding error of the stored position.
  [[nodiscard]] std::array<double, 3> position_m(std::size_t voxel) const;

  /// Return momentum over mass, m/s, and moment of momentum over moment of inertia, rad/s, of a voxel.
  [[nodiscard]] std::array<double, 3> velocity_m_s(std::size_t voxel) const;
  [[nodiscard]] std::array<double, 3> angular_velocity_rad_s(std::size_t voxel) const;

  /// Moves the origin to the body if the middle of the body is farther than eight edges from where it was. Positions in the world
  /// stay the same to 1e-7 of a rounding error.
  /// @return whether the origin was moved
  bool take_origin_along();

  /// Whether take_origin_along would move the origin of a body with this mean of its positions, m from the origin.
  [[nodiscard]] bool is_far(const std::array<double, 3>& middle_m) const;

  [[nodiscard]] bool uniform() const { return uniform_; }

  /// Sets all sizes and their rates to the drive with this sine and cosine. In the following steps the kernels do this.
  void set_sizes(double sine, double cosine);

  /// Sets all sizes and their rates to a drive that the kernels cannot compute.
  void set_sizes(const DriveMoment& moment);

 private:
  void allocate(const Lattice& lattice);
  void put_position(std::size_t voxel, const std::array<double, 3>& world_m);
  [[nodiscard]] bool move_origin(const std::vector<std::array<double, 3>>& positions_m);
  void place_on_grid(const Lattice& lattice, const std::vector<std::array<double, 3>>& displacements_m);
  void place_voxels(const VoxelBody& body, const VoxelLoads& loads);
  void fill_tables(const BodyClasses& classes);
  void fill_beams(const VoxelBody& body);
  [[nodiscard]] std::array<double, 3> rate_of(std::size_t voxel, int first, int inverse) const;

  double edge_;
  std::size_t all_voxels_ = 0;  ///< with padding and the four ends of padding beams
  bool uniform_ = true;
  std::array<double, 3> origin_{};       ///< m
  std::array<double, 3> grid_middle_{};  ///< mean of the positions on the grid, m
  AlignedArray<Real> pose_, motion_, load_, residual_, external_;
  AlignedArray<Real> size_base_, size_sine_, size_cosine_;
  AlignedArray<Real> voxel_table_, beam_table_;
  std::vector<std::int32_t> voxel_class_;
  std::array<std::vector<std::int32_t>, 3> lower_, upper_, beam_class_;
  std::array<AlignedArray<Real>, 3> history_, rest_length_, rest_length_rate_, half_kink_;
};

}  // namespace menger::voxel
