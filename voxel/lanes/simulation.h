#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "meshes/design/polycube.h"
#include "voxel/engine/divergence.h"
#include "voxel/engine/energy_ledger.h"
#include "voxel/engine/frame.h"
#include "voxel/engine/voxel_loads.h"
#include "voxel/kernels/kernel_choice.h"
#include "voxel/model/parameters.h"
#include "voxel/model/strain_range.h"

namespace menger::voxel {

class Engine;
enum class LaneUse;
enum class Stepper;
struct DeviceAdvance;

/// Thrown for a calibrated body that cannot be simulated with its drive. Either the body with its drive lies outside the range of
/// validity and the rule is OutsideRange::refuse, or its walls have no size under the drive, for any rule. what() is the
/// sentences of voxel::outside_validity and sizeless_walls, joined by "; ". It is an exception type of its own because a search
/// meets such bodies among others.
class OutsideValidity : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A simulation of a body of voxels in motion: point masses joined by Euler-Bernoulli beams with driven rest lengths (Voxelyze's
/// model at Poisson's ratio 0).
///
/// It is deterministic: the same body, physics and options give the same bytes in every run and in every thread, with every
/// instruction set.
/// @cite hiller2014dynamic
class Simulation {
 public:
  /// @param body whole aggregate, at least one cell. A cell is one voxel, or voxels_per_cell^3 voxels if physics.surrogate says
  /// so; the voxels are then those of calibrated_voxels, in grid order @param cell_edge_m > 0
  /// @throws std::invalid_argument if a parameter is outside the range stated in its declaration, or if the body and its drive do
  /// not suit the calibrated parameters (another cell edge, phases that the chambers cannot have)
  /// @throws OutsideValidity (an std::invalid_argument) as described there, before anything is built
  Simulation(const meshes::Polycube& body, double cell_edge_m, const Physics& physics, const VoxelLoads& loads = {},
             const KernelOptions& options = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Takes steps until time_s() >= time_s, the run diverges or `stop` becomes true. Returns completed, diverged or stopped.
  /// @throws std::invalid_argument for more than 1e18 steps
  [[nodiscard]] io::RunStatus advance_to(double time_s, const std::atomic<bool>* stop = nullptr);

  /// Takes `steps` steps unless the run diverges or `stop` becomes true. Returns completed, diverged or stopped.
  [[nodiscard]] io::RunStatus advance(std::uint64_t steps, const std::atomic<bool>* stop = nullptr);

  /// Sets how many threads share every step from now on, as KernelOptions::threads does at the start. @param threads >= 1
  void set_threads(int threads);

  [[nodiscard]] double time_s() const;  ///< steps() * time_step_s()
  [[nodiscard]] std::uint64_t steps() const;
  [[nodiscard]] double time_step_s() const;
  [[nodiscard]] std::size_t voxel_count() const;
  [[nodiscard]] std::size_t beam_count() const;

  /// What happened in a run with status `diverged`; otherwise nothing.
  [[nodiscard]] const std::optional<Divergence>& divergence() const;

  /// Mass-weighted mean position, m.
  [[nodiscard]] std::array<double, 3> centre_of_mass_m() const;

  /// State of all voxels now.
  [[nodiscard]] Frame frame() const;

  /// State of one voxel: position (m), orientation (quaternion w, x, y, z), velocity (m/s) and angular velocity (rad/s).
  [[nodiscard]] std::array<double, 3> position_m(std::size_t voxel) const;
  [[nodiscard]] std::array<double, 4> orientation(std::size_t voxel) const;
  [[nodiscard]] std::array<double, 3> velocity_m_s(std::size_t voxel) const;
  [[nodiscard]] std::array<double, 3> angular_velocity_rad_s(std::size_t voxel) const;
  [[nodiscard]] bool is_in_static_friction(std::size_t voxel) const;

  /// Number of beams that were in the large-angle state in the last step.
  [[nodiscard]] std::size_t large_angle_beams() const;

  /// Lines for the log: which terms the step leaves out and why, and which instruction set it uses.
  [[nodiscard]] std::vector<std::string> kernel_report() const;

  /// How often collision work was done or skipped, and how often the list of close pairs was rebuilt.
  [[nodiscard]] CollisionCounts collision_counts() const;

  /// Smallest and largest axial strain over all beams and steps so far; only for a calibrated body.
  [[nodiscard]] std::optional<StrainRange> strain_range() const;

  /// Sentences on everything that lies outside the range of validity of calibrated parameters: the body and its drive (see
  /// voxel::outside_validity), and the strains so far. Empty for solid voxels.
  [[nodiscard]] std::vector<std::string> outside_validity() const;

  /// The energy balance from the start to the beginning of the last step; only with KernelOptions::energy_ledger.
  [[nodiscard]] const std::optional<EnergyLedger>& energy() const;

 private:
  friend std::vector<io::RunStatus> advance_together_to(std::span<Simulation>, double, const std::atomic<bool>*, InstructionSet,
                                                        LaneUse);
  friend DeviceAdvance advance_on_device_to(std::span<Simulation>, double, const std::atomic<bool>*, Stepper);

  std::unique_ptr<Engine> engine_;
  std::vector<std::string> outside_validity_;  ///< sentences on a calibrated body and its drive, fixed at the start
};

}  // namespace menger::voxel
