#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "voxel/engine/energy_balance.h"
#include "voxel/engine/foot_contact.h"
#include "voxel/engine/moving_body.h"
#include "voxel/engine/rest_lengths.h"
#include "voxel/kernels/instruction_sets.h"

namespace menger::voxel {

/// Steps one body. The interface is the same for all number types.
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  /// Takes `steps` steps, unless the body diverges or `stop` becomes true.
  /// @return completed, diverged or stopped
  [[nodiscard]] virtual io::RunStatus advance(std::uint64_t steps, const std::atomic<bool>* stop) = 0;

  /// Sets how many threads share every step from now on. An engine that has no work for more than one ignores it.
  /// @param threads >= 1
  virtual void set_threads(int threads) = 0;

  [[nodiscard]] virtual const VoxelBody& body() const = 0;
  [[nodiscard]] virtual const RunRecord& record() const = 0;

  /// The state of a voxel in SI units and double.
  struct VoxelView {
    std::array<double, 3> position_m, velocity_m_s, angular_velocity_rad_s;
    std::array<double, 4> orientation;
    double size_m;                  ///< see Frame
    std::array<double, 6> reach_m;  ///< see Frame
    bool is_static;
    bool touches_floor;
  };
  [[nodiscard]] virtual VoxelView view(std::size_t voxel) const = 0;
  /// Returns the strains of all voxels, see Frame::strain.
  [[nodiscard]] virtual std::vector<double> strains() const = 0;
  /// Returns the number of beams in the large-angle state, see published_state.
  [[nodiscard]] virtual std::size_t large_angle_beams() const = 0;
  /// Returns for every voxel whether its collision sphere overlaps that of another voxel.
  [[nodiscard]] virtual std::vector<bool> in_contact_with_others() const = 0;
  /// Returns the energy balance, if KernelOptions::energy_ledger asks for it.
  [[nodiscard]] virtual const std::optional<EnergyLedger>& energy() const = 0;
  [[nodiscard]] virtual CollisionCounts collision_counts() const = 0;
  /// Returns lines of text: the kernels in use and the terms that they leave out.
  [[nodiscard]] virtual std::vector<std::string> kernel_report() const = 0;
};

/// Returns the number of the first step that ends at or after a time (s).
/// @throws std::invalid_argument for more than 1e18 steps
std::uint64_t steps_until(double time_s, double time_step_s);

/// Engine for one number type. It steps a body voxel by voxel.
template <class Real>
class EngineOf : public Engine {
 public:
  /// See Simulation.
  EngineOf(const meshes::Polycube& body, double cell_edge_m, const Physics& physics, const VoxelLoads& loads,
           const KernelOptions& options);

  [[nodiscard]] io::RunStatus advance(std::uint64_t steps, const std::atomic<bool>* stop) override;
  void set_threads(int /*threads*/) override {}
  [[nodiscard]] const VoxelBody& body() const override { return moving_.body(); }
  [[nodiscard]] const RunRecord& record() const override { return moving_.record(); }
  [[nodiscard]] VoxelView view(std::size_t voxel) const override;
  [[nodiscard]] std::vector<double> strains() const override;
  [[nodiscard]] std::size_t large_angle_beams() const override;
  [[nodiscard]] std::vector<bool> in_contact_with_others() const override;
  [[nodiscard]] const std::optional<EnergyLedger>& energy() const override { return energy_; }
  [[nodiscard]] CollisionCounts collision_counts() const override;
  [[nodiscard]] std::vector<std::string> kernel_report() const override;

  /// The body itself, for engines that sweep it in another way (AggregateEngine, LaneGroup).
  [[nodiscard]] MovingBody<Real>& moving_body() { return moving_; }
  [[nodiscard]] const MovingBody<Real>& moving_body() const { return moving_; }

  /// Returns the feet of a calibrated body on a floor; null for others.
  [[nodiscard]] FootContact<Real>* feet() { return feet_.get(); }

  [[nodiscard]] const KernelOptions& options() const { return options_; }
  [[nodiscard]] InstructionSet instruction_set() const { return set_; }  ///< of its kernels

 protected:
  /// The lines of the report that do not depend on how the body is swept.
  [[nodiscard]] const std::vector<std::string>& report_of_body() const { return report_; }

 private:
  void choose_kernels();
  void add_parts();
  void report_body();
  void step();
  void add_contacts();

  /// Returns how the beams of the body differ.
  /// @param uniform whether beams without rest lengths of their own are swept with one set of coefficients
  [[nodiscard]] BeamVariety variety(bool uniform) const {
    if (moving_.data().axis[0].half_kink != nullptr) return BeamVariety::own_kinks;
    return body().hollow ? BeamVariety::own_lengths : uniform ? BeamVariety::uniform : BeamVariety::classes;
  }

  KernelOptions options_;
  InstructionSet set_;
  const StepKernels<Real>& kernels_;
  MovingBody<Real> moving_;
  bool uniform_;  ///< coefficients per voxel and beam are left out
  bool floor_, gravity_;
  typename StepKernels<Real>::BeamSweep beams_ = nullptr;
  typename StepKernels<Real>::VoxelSweepFunction voxels_ = nullptr;
  std::unique_ptr<LateralCoupling<Real>> coupling_;
  std::unique_ptr<FootContact<Real>> feet_;  ///< of a calibrated body on a floor, in place of the kernels' floor
  std::unique_ptr<EnergyBalance> balance_;   ///< double only
  std::optional<EnergyLedger> energy_;
  std::vector<std::int32_t> touching_;  ///< room for the touching pairs
  std::vector<std::string> report_;
};

}  // namespace menger::voxel
