#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "voxel/engine/collisions.h"
#include "voxel/engine/contact_search.h"
#include "voxel/engine/energy_books.h"
#include "voxel/engine/foot_contact.h"
#include "voxel/engine/pressure_drive.h"
#include "voxel/engine/rest_lengths.h"
#include "voxel/engine/simulation.h"
#include "voxel/engine/voxel_state.h"

namespace menger::voxel {

/// What a Simulation does, behind its number type.
class Simulation::Engine {
 public:
  virtual ~Engine() = default;

  [[nodiscard]] virtual io::RunStatus advance(std::uint64_t steps, const std::atomic<bool>* stop) = 0;
  virtual void set_threads(int threads) = 0;

  /// A voxel in SI units and double.
  struct VoxelView {
    std::array<double, 3> position_m, velocity_m_s, angular_velocity_rad_s;
    std::array<double, 4> orientation;
    double size_m;                  ///< see Frame
    std::array<double, 6> reach_m;  ///< see Frame
    bool is_static;
    bool touches_floor;
  };
  [[nodiscard]] virtual VoxelView view(std::size_t voxel) const = 0;
  [[nodiscard]] virtual std::vector<double> strains() const = 0;
  [[nodiscard]] virtual std::size_t large_angle_beams() const = 0;
  [[nodiscard]] virtual std::vector<bool> in_contact_with_others() const = 0;
  [[nodiscard]] virtual std::vector<std::string> kernel_report() const = 0;

  /// Cell of the design that a voxel belongs to.
  [[nodiscard]] meshes::CellIndex cell_of(std::size_t voxel) const;

  std::unique_ptr<Lattice> lattice;
  Physics physics;
  double cell_edge_m = 0.0;
  double time_step_s = 0.0;
  std::uint64_t steps = 0;
  std::vector<double> mass_kg;  ///< per voxel
  std::vector<double> phases;
  std::optional<Divergence> divergence;
  std::optional<EnergyLedger> energy;
  std::optional<StrainRange> strain_range;    ///< of a calibrated body
  std::vector<std::string> outside_validity;  ///< of its body and drive, known from the start
  CollisionCounts collision_counts;
};

/// Number of the first step that ends at or after a time (s). @throws std::invalid_argument for more than 1e18 steps
std::uint64_t steps_until(double time_s, double time_step_s);

template <class Real>
class BlockLanes;

/// The engine for one number type.
template <class Real>
class EngineOf final : public Simulation::Engine {
 public:
  EngineOf(const meshes::Polycube& body, double edge_m, const Physics& given, const VoxelLoads& loads,
           const KernelOptions& options);
  ~EngineOf() override;
  EngineOf(const EngineOf&) = delete;
  EngineOf& operator=(const EngineOf&) = delete;

  io::RunStatus advance(std::uint64_t count, const std::atomic<bool>* stop) override;
  void set_threads(int threads) override;
  VoxelView view(std::size_t voxel) const override;
  std::vector<double> strains() const override;
  std::size_t large_angle_beams() const override;
  std::vector<bool> in_contact_with_others() const override;
  std::vector<std::string> kernel_report() const override;

  /// Whether this robot can be stepped in a lane beside others: solid voxels without lateral coupling, without loads, with a
  /// drive that is a sine.
  [[nodiscard]] bool runs_in_lanes() const;

 private:
  template <class>
  friend class LaneGroup;
  template <class>
  friend class BlockLanes;

  /// @param uniform whether coefficients are left out of beams without rest lengths of their own
  [[nodiscard]] BeamVariety variety(bool uniform) const {
    return hollow_ ? BeamVariety::own_lengths : uniform ? BeamVariety::uniform : BeamVariety::classes;
  }
  void choose_kernels(const KernelOptions& options);
  void prepare_collisions(const VoxelLoads& loads);
  void prepare_drive();
  void drive_to(double time_s);
  void check_validity();
  void add_collisions();
  [[nodiscard]] bool looks_at_pairs();
  void find_kinds();
  template <class SizeOf>
  [[nodiscard]] std::array<double, 2> sizes_of_kinds(const SizeOf& size_of) const;
  void report_left_out_terms();
  void prepare_blocks();
  [[nodiscard]] bool blocks_pay() const;
  bool step();
  [[nodiscard]] bool looks_at_origin_after(double displacement_m) const;
  void stay_near_origin(double largest_displacement_m);
  void note_strain();
  void note_speed();
  [[nodiscard]] double rest_length(std::size_t axis, std::size_t beam) const;

  std::optional<HollowVoxels> hollow_;
  BodyClasses classes_;
  std::unique_ptr<VoxelState<Real>> state_;
  std::unique_ptr<PressureDrive<Real>> pressures_;
  std::unique_ptr<LateralCoupling<Real>> coupling_;
  std::unique_ptr<FootContact<Real>> feet_;  ///< of a calibrated body on a floor, in place of the kernels' floor
  std::unique_ptr<VerletList> close_pairs_;
  std::unique_ptr<EnergyBooks> books_;  ///< double only
  typename StepKernels<Real>::BeamSweep beams_ = nullptr;
  typename StepKernels<Real>::VoxelSweepFunction voxels_ = nullptr;
  const StepKernels<Real>* kernels_ = nullptr;
  InstructionSet set_ = InstructionSet::scalar;  ///< that the kernels are of
  std::unique_ptr<BlockLanes<Real>> blocks_;     ///< of a body whose blocks go in lanes
  std::unique_ptr<ContactSearch<Real>> contacts_;
  std::vector<std::int32_t> touching_;  ///< room for what it finds

  /// Voxels of the kinds of drive that close pairs tell apart; none where there are more than two.
  std::optional<std::array<std::int32_t, 2>> of_kind_;
  double largest_size_m_ = 0.0;  ///< of any voxel against others
  bool floor_ = true, gravity_ = true, every_term_ = false;
  bool blocks_in_lanes_ = true;  ///< on request
  int threads_ = 1;
  KeptTerms kept_;
  bool actuated_ = true;  ///< by the kernels
  bool shaped_ = false;   ///< sizes are set between the steps, because the drive is more than a sine
  double speed_limit_m_s_ = 0.0;
  double floor_depth_m_ = 0.0;  ///< of the floor under the world's z = 0
  double way_m_ = 0.0;          ///< bound on how far any voxel went since the origin was last looked at
  std::vector<std::string> report_;
};

/// Sizes (m) of the kinds of voxels that close pairs tell apart, or the largest there may be. @param size_of gives that of a
/// voxel
template <class Real>
template <class SizeOf>
std::array<double, 2> EngineOf<Real>::sizes_of_kinds(const SizeOf& size_of) const {
  if (!of_kind_) return {largest_size_m_, largest_size_m_};
  return {static_cast<double>(size_of((*of_kind_)[0])), static_cast<double>(size_of((*of_kind_)[1]))};
}

}  // namespace menger::voxel
