#include "fem/implicit_locomotion/implicit_locomotion.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fem/elements/element_kernel.h"
#include "fem/implicit/implicit_dynamics.h"
#include "fem/implicit_locomotion/implicit_ranks.h"
#include "fem/memory/memory_estimate.h"
#include "fem/motion/state_check.h"
#include "fem/space/rank_gather.h"
#include "fem/space/space.h"
#include "io/process/machine_memory.h"
#include "io/text/input_error.h"

namespace menger::fem {
namespace {

Body body_of(const LocomotionStudy& study) {
  Body body;
  const WalkMaterial& material = study.material;
  body.regions.assign(study.mesh.region_names.size(),
                      {material.law, materials::SimoTaylorVolume{material.bulk_modulus_Pa}, material.density_kg_per_m3});
  for (const meshes::Chamber& chamber : study.mesh.chambers) body.chambers.push_back({chamber.labels, chamber.plenum});
  body.plenum_count = study.mesh.plenum_names.size();
  body.gravity_m_per_s2 = {0.0, 0.0, -study.gravity_m_per_s2};
  return body;
}

ImplicitOptions options_of(const LocomotionStudy& study, const std::atomic<bool>* stop) {
  ImplicitOptions options;
  for (const PlenumSupply& supply : study.supply->plena()) options.schedules.push_back(std::get<PlenumSchedule>(supply));
  options.viscosities_Pa_s.assign(study.mesh.region_names.size(), study.material.viscosity_Pa_s);
  // That of explicit dynamics, so that both move the same nodes.
  options.lumped_mass = study.implicit->degree == 1;
  options.mass_damping_per_s = study.mass_damping_per_s;
  options.ground = study.ground;
  options.stick_stiffness = study.implicit->stick_stiffness;
  options.tolerance = study.implicit->tolerance;
  options.largest_step_s = std::min(options.largest_step_s, study.largest_step_s.value_or(options.largest_step_s));
  options.first_step_s = std::min(options.first_step_s, options.largest_step_s);
  options.smallest_step_s = std::min(options.smallest_step_s, options.largest_step_s);
  options.stop = stop;
  return options;
}

/// The node at each point of the mesh that a space was made from, by global number, on the first rank; nothing elsewhere. Points
/// of the mesh may coincide: modules that touch along an edge only are not bonded there. So a point is found by the elements that
/// have it and not by its place. Collective. @param space without refinements
std::vector<std::size_t> nodes_at_points(const Space& space, const meshes::HexahedralMesh& mesh) {
  constexpr std::size_t corners = 8;
  std::vector<double> own;  // per element: its number in the mesh and the nodes at its corners
  const auto along_edge = static_cast<std::size_t>(space.degree);
  for (std::size_t e = 0; e < space.mesh_elements.size(); ++e) {
    own.push_back(static_cast<double>(space.mesh_elements[e]));
    for (std::size_t c = 0; c < corners; ++c) {
      const std::size_t at = along_edge * ((c & 1) + (along_edge + 1) * ((c >> 1 & 1) + (along_edge + 1) * (c >> 2)));
      own.push_back(static_cast<double>(space.global_node(space.element_nodes[e * space.nodes_per_element() + at])));
    }
  }
  const std::vector<double> all = gather_on_first(space.communicator, own);
  std::vector<std::size_t> nodes(all.empty() ? 0 : mesh.points.size());
  for (auto at = all.begin(); at != all.end(); at += 1 + corners) {
    const meshes::ElementCorners& points = mesh.elements[static_cast<std::size_t>(*at)];
    for (std::size_t c = 0; c < corners; ++c) nodes[points[c]] = static_cast<std::size_t>(at[1 + static_cast<std::ptrdiff_t>(c)]);
  }
  return nodes;
}

/// Makes the nodes and elements of a study. @throws io::InputError with the keys that decide it if they would not fit into memory
Space checked_space(const LocomotionStudy& study) {
  const int degree = study.implicit->degree;
  const std::string obstacle = obstacle_of_memory(body_size(study.mesh, degree, 0), degree, {}, io::machine_memory_bytes());
  if (!obstacle.empty()) {
    throw io::InputError(obstacle + "; lower elements.degree = " + std::to_string(degree) +
                         ", design.elements_through_wall = " + std::to_string(study.hollow.elements_through_wall) +
                         ", or give design.largest_element_m or dynamics.method = \"explicit\"");
  }
  return make_space(study.mesh, degree, 0, MPI_COMM_WORLD);
}

/// What all ranks do together.
enum class Task : int { end, advance, set_state, state, record, displacements, velocities };

/// The body of a study on all ranks of a communicator. The first rank is asked and tells the others, which listen.
class ImplicitLocomotion final : public WalkDynamics {
 public:
  ImplicitLocomotion(const LocomotionStudy& study, const std::atomic<bool>* stop)
      : body_(body_of(study)),
        space_(checked_space(study)),
        dynamics_(space_, body_, options_of(study, stop)),
        ground_node_count_(dynamics_.state().ground_nodes.size()) {
    MPI_Comm_size(space_.communicator, &rank_count_);
    int rank = 0;
    MPI_Comm_rank(space_.communicator, &rank);
    is_first_ = rank == 0;
    nodes_ = nodes_at_points(space_, study.mesh);
    MPI_Allreduce(&ground_node_count_, &all_ground_nodes_, 1, MPI_UNSIGNED_LONG, MPI_SUM, space_.communicator);
  }
  ImplicitLocomotion(const ImplicitLocomotion&) = delete;
  ImplicitLocomotion& operator=(const ImplicitLocomotion&) = delete;
  ~ImplicitLocomotion() override {
    if (is_first_) tell(Task::end);
  }

  /// Does what the first rank is asked to, until its body is gone. For all others.
  void listen() {
    for (;;) {
      switch (next_task()) {
        case Task::end:
          return;
        case Task::advance:
          (void)advance_together(0.0);
          break;
        case Task::set_state:
          set_state_together({});
          break;
        case Task::state:
          (void)state_of_all_ranks(space_, dynamics_.state());
          break;
        case Task::record:
          (void)record_together();
          break;
        case Task::displacements:
          (void)field_of_all_ranks(space_, dynamics_.state().displacements_m);
          break;
        case Task::velocities:
          (void)field_of_all_ranks(space_, dynamics_.state().velocities_m_per_s);
          break;
      }
    }
  }

  WalkOutcome advance_to(double time_s) override {
    tell(Task::advance);
    return advance_together(time_s);
  }
  void set_state(WalkState state) override {
    tell(Task::set_state);
    set_state_together(std::get<ImplicitState>(state));
  }
  [[nodiscard]] std::string misfit(const WalkState& state) const override {
    const auto* all = std::get_if<ImplicitState>(&state);
    if (all == nullptr) return "it is a state of explicit dynamics";
    StateCheck check;
    const std::size_t components = 3 * static_cast<std::size_t>(space_.node_count);
    check.numbers("displacements_m", all->displacements_m, components)
        .numbers("velocities_m_per_s", all->velocities_m_per_s, components)
        .finite("time_s", {all->time_s, all->next_step_s})
        .expect(all->next_step_s >= 0.0, "the length of its steps is out of range")
        .work(all->work)
        .finite("energy", {all->at_start_J.value_or(0.0)});
    if (!all->accelerations_m_per_s2.empty()) check.numbers("accelerations_m_per_s2", all->accelerations_m_per_s2, components);
    if (!all->ground_nodes.empty()) check.counts("ground_nodes", all->ground_nodes.size(), all_ground_nodes_);
    for (const GroundNode& node : all->ground_nodes)
      check.finite("anchor_m", node.anchor_m).finite("friction_N", node.friction_N);
    return check.reason();
  }
  [[nodiscard]] WalkState state() const override {
    tell(Task::state);
    return state_of_all_ranks(space_, dynamics_.state());
  }
  [[nodiscard]] double time_s() const override { return dynamics_.state().time_s; }
  [[nodiscard]] std::size_t steps() const override { return dynamics_.state().steps; }
  [[nodiscard]] bool goes_on_from_any_state() const override { return false; }
  /// Sums over other numbers of ranks are rounded otherwise, and nodes are counted otherwise.
  [[nodiscard]] std::string machine_text() const override {
    const std::string instruction_set(best_element_kernels().instruction_set);
    return rank_count_ == 1 ? instruction_set : instruction_set + ", " + std::to_string(rank_count_) + " processes";
  }
  [[nodiscard]] WalkRecord record() override {
    tell(Task::record);
    return record_together();
  }
  [[nodiscard]] std::vector<double> displacements_m() const override {
    tell(Task::displacements);
    return at_points(field_of_all_ranks(space_, dynamics_.state().displacements_m));
  }
  [[nodiscard]] std::vector<double> velocities_m_per_s() override {
    tell(Task::velocities);
    return at_points(field_of_all_ranks(space_, dynamics_.state().velocities_m_per_s));
  }

 private:
  void tell(Task task) const {
    if (rank_count_ > 1) MPI_Bcast(&task, 1, MPI_INT, 0, space_.communicator);
  }
  [[nodiscard]] Task next_task() const {
    auto task = Task::end;
    MPI_Bcast(&task, 1, MPI_INT, 0, space_.communicator);
    return task;
  }

  /// @param time_s counts on the first rank alone, as do all arguments below
  WalkOutcome advance_together(double time_s) {
    MPI_Bcast(&time_s, 1, MPI_DOUBLE, 0, space_.communicator);
    const ImplicitReport& report = dynamics_.advance_to(time_s);
    return {report.status, report.reason};
  }
  void set_state_together(const ImplicitState& state) {
    dynamics_.set_state(state_of_this_rank(space_, dynamics_.assembly().exchange(), state, ground_node_count_));
  }
  WalkRecord record_together() {
    WalkRecord record;
    record.time_s = dynamics_.state().time_s;
    record.centre_of_mass_m = dynamics_.centre_of_mass_m();
    for (std::size_t p = 0; p < body_.plenum_count; ++p) record.plenum_pressures_Pa.push_back(dynamics_.plenum_pressure_Pa(p));
    record.chamber_volumes_m3 = dynamics_.chamber_volumes_m3();
    record.energies = dynamics_.energies();
    record.ground_force_N = dynamics_.ground_force_N();
    return record;
  }
  [[nodiscard]] std::vector<double> at_points(const std::vector<double>& field) const {
    std::vector<double> result;
    result.reserve(3 * nodes_.size());
    for (const std::size_t node : nodes_)
      for (std::size_t i = 0; i < 3; ++i) result.push_back(field[3 * node + i]);
    return result;
  }

  Body body_;
  Space space_;
  ImplicitDynamics dynamics_;
  std::size_t ground_node_count_;
  std::size_t all_ground_nodes_ = 0;  ///< of all ranks
  int rank_count_ = 1;
  bool is_first_ = true;
  std::vector<std::size_t> nodes_;  ///< of all ranks, at the points of the mesh; on the first rank
};

}  // namespace

std::unique_ptr<WalkDynamics> make_implicit_locomotion(const LocomotionStudy& study, const std::atomic<bool>* stop) {
  return std::make_unique<ImplicitLocomotion>(study, stop);
}

void help_implicit_locomotion(const LocomotionStudy& study, const std::atomic<bool>* stop) {
  ImplicitLocomotion(study, stop).listen();
}

}  // namespace menger::fem
