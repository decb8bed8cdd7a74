#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "voxel/collisions.h"
#include "voxel/energy_books.h"
#include "voxel/simulation.h"
#include "voxel/voxel_state.h"

namespace menger::voxel {

/// What a Simulation does, behind its number type.
class Simulation::Engine {
 public:
  virtual ~Engine() = default;

  [[nodiscard]] virtual io::RunStatus advance(std::uint64_t steps, const std::atomic<bool>* stop) = 0;

  /// A voxel in SI units and double.
  struct VoxelView {
    std::array<double, 3> position_m, velocity_m_s, angular_velocity_rad_s;
    std::array<double, 4> orientation;
    double size_m;
    bool is_static;
  };
  [[nodiscard]] virtual VoxelView view(std::size_t voxel) const = 0;
  [[nodiscard]] virtual std::vector<double> strains() const = 0;
  [[nodiscard]] virtual std::size_t large_angle_beams() const = 0;
  [[nodiscard]] virtual std::vector<bool> in_contact_with_others() const = 0;
  [[nodiscard]] virtual std::vector<std::string> kernel_report() const = 0;

  std::unique_ptr<Lattice> lattice;
  Physics physics;
  double cell_edge_m = 0.0;
  double time_step_s = 0.0;
  std::uint64_t steps = 0;
  std::vector<double> mass_kg;  ///< per voxel
  std::vector<double> phases;
  std::optional<Divergence> divergence;
  std::optional<EnergyLedger> energy;
  CollisionCounts collision_counts;
};

/// The engine for one number type.
template <class Real>
class EngineOf final : public Simulation::Engine {
 public:
  EngineOf(const meshes::Polycube& body, double edge_m, const Physics& given, const VoxelLoads& loads,
           const KernelOptions& options);

  io::RunStatus advance(std::uint64_t count, const std::atomic<bool>* stop) override;
  VoxelView view(std::size_t voxel) const override;
  std::vector<double> strains() const override;
  std::size_t large_angle_beams() const override;
  std::vector<bool> in_contact_with_others() const override;
  std::vector<std::string> kernel_report() const override;

 private:
  void choose_kernels(const KernelOptions& options);
  void prepare_collisions(const VoxelLoads& loads);
  void add_collisions();
  bool step();
  void note_strain();
  void note_speed();
  [[nodiscard]] double rest_length(std::size_t axis, std::size_t beam) const;

  ClassTables tables_;
  std::unique_ptr<VoxelState<Real>> state_;
  std::unique_ptr<VerletList> close_pairs_;
  std::unique_ptr<EnergyBooks> books_;  ///< double only
  typename StepKernels<Real>::BeamSweep beams_ = nullptr;
  typename StepKernels<Real>::VoxelSweepFunction voxels_ = nullptr;
  bool floor_ = true, gravity_ = true, actuated_ = true, every_term_ = false;
  double speed_limit_m_s_ = 0.0;
  std::vector<std::string> report_;
};

}  // namespace menger::voxel
