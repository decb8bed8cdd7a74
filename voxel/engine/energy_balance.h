#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "voxel/engine/energy_ledger.h"
#include "voxel/engine/foot_contact.h"
#include "voxel/engine/rest_lengths.h"
#include "voxel/kernels/step_data.h"
#include "voxel/laws/rotation.h"

namespace menger::voxel {

/// Takes a step as the scalar kernels do, and computes its energy balance (EnergyLedger).
///
/// A step is split as with the kernels: `add_beam_loads`, then the contacts between voxels, which the caller adds, then
/// `move_voxels`.
class EnergyBalance {
 public:
  /// @param variety, velocity, floor, gravity, actuated terms of the step, as for the kernels
  /// @param coupling or null
  /// @param feet or null; their loads are added with the contacts, but their work is counted separately
  EnergyBalance(const StepData<double>& data, BeamVariety variety, bool velocity, bool floor, bool gravity, bool actuated,
                LateralCoupling<double>* coupling, const FootContact<double>* feet);

  /// Adds the loads of all beams and of their lateral coupling.
  /// @return whether a strain is out of range or not finite
  bool add_beam_loads();

  /// Moves the voxels. The loads that were added since add_beam_loads, except those of the feet, count as collisions.
  VoxelSweep move_voxels();

  [[nodiscard]] const EnergyLedger& ledger() const { return ledger_; }

 private:
  /// Kinds of load on a voxel. The work of a kind over a step is the mean of its loads at both ends of the step times the
  /// displacement.
  enum Kind { elastic, bond_damping, global_damping, floor_normal, friction, collision, external, kinds };
  struct Load {
    Vector3<double> force{0, 0, 0};
    Vector3<double> moment{0, 0, 0};
  };
  struct VoxelBalance {
    std::array<Load, kinds> load;
    std::array<Load, kinds> last_load;
    Vector3<double> last_displacement{0, 0, 0};
    Vector3<double> last_turn{0, 0, 0};
  };

  template <int Axis, bool Velocity, BeamVariety Variety>
  bool add_axis();
  template <bool Velocity, BeamVariety Variety>
  bool add_axes();
  template <bool Velocity>
  bool add_all_axes();
  void add_actuation();
  template <bool Floor, bool Gravity>
  VoxelSweep move(VoxelSweep (*sweep)(const StepData<double>&));
  void add_feet(VoxelBalance& balance, std::size_t voxel);
  void add_work(VoxelBalance& balance);

  const StepData<double>* data_;
  BeamVariety variety_;
  bool velocity_, floor_, gravity_, actuated_;
  LateralCoupling<double>* coupling_;
  const FootContact<double>* feet_;
  bool first_ = true;
  std::vector<VoxelBalance> balance_;
  std::vector<double> rest_length_, last_rest_length_;              ///< per beam, axis after axis
  std::vector<double> rest_length_force_, last_rest_length_force_;  ///< -dU/d(rest length)
  /// Per beam, y and z, the same for half the kinks; empty where no beam has one.
  std::vector<std::array<double, 2>> half_kink_, last_half_kink_, half_kink_moment_, last_half_kink_moment_;
  std::array<double, kinds> work_{};
  double start_height_weight_J_ = 0.0;
  EnergyLedger ledger_;
};

}  // namespace menger::voxel
