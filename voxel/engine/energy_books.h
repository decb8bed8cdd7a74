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

/// Takes a step like the scalar kernels do, and keeps the energy ledger beside it.
///
/// A step is split as a kernel's: `add_beam_loads`, then contacts between voxels from outside, then `move_voxels`.
class EnergyBooks {
 public:
  /// @param variety, velocity, floor, gravity, actuated: the terms of the step, as for the kernels @param coupling or null
  /// @param feet or null; their loads are added with the contacts, and booked apart from them
  EnergyBooks(const StepData<double>& data, BeamVariety variety, bool velocity, bool floor, bool gravity, bool actuated,
              LateralCoupling<double>* coupling, const FootContact<double>* feet);

  /// Adds the loads of all beams and of their coupling; true if a strain is out of range or not finite.
  bool add_beam_loads();

  /// To be called between the two: what was added to the loads since add_beam_loads is the work of collisions.
  VoxelSweep move_voxels();

  [[nodiscard]] const EnergyLedger& ledger() const { return ledger_; }

 private:
  /// Force and moment of every kind on a voxel; the work of a kind over a step is the mean of its loads at both ends times the
  /// displacement.
  enum Kind { elastic, bond_damping, global_damping, floor_normal, friction, collision, external, kinds };
  struct Load {
    Vector3<double> force{0, 0, 0};
    Vector3<double> moment{0, 0, 0};
  };
  struct VoxelBook {
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
  void book_actuation();
  template <bool Floor, bool Gravity>
  VoxelSweep move(VoxelSweep (*sweep)(const StepData<double>&));
  void book_feet(VoxelBook& book, std::size_t voxel);
  void book_work(VoxelBook& book);

  const StepData<double>* data_;
  BeamVariety variety_;
  bool velocity_, floor_, gravity_, actuated_;
  LateralCoupling<double>* coupling_;
  const FootContact<double>* feet_;
  bool first_ = true;
  std::vector<VoxelBook> books_;
  std::vector<double> rest_length_, last_rest_length_;              ///< per beam, axis after axis
  std::vector<double> rest_length_force_, last_rest_length_force_;  ///< -dU/d(rest length)
  std::array<double, kinds> work_{};
  double start_height_weight_J_ = 0.0;
  EnergyLedger ledger_;
};

}  // namespace menger::voxel
