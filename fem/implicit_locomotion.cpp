#include "fem/implicit_locomotion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "fem/element_kernel.h"
#include "fem/implicit_dynamics.h"
#include "fem/self_contact_surface.h"
#include "fem/space.h"
#include "io/input_error.h"

namespace menger::fem {
namespace {

Body body_of(const LocomotionStudy& study) {
  Body body;
  const LocomotionMaterial& material = study.material;
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

/// The node of a space at each point of the mesh that it was made from: same places but for rounding.
std::vector<std::size_t> nodes_at_points(const Space& space, const meshes::HexahedralMesh& mesh) {
  const double unit = 0.01 * shortest_edge_m(mesh);
  using Key = std::array<long, 3>;
  const auto key_of = [&](const auto& place) {
    return Key{std::lround(place[0] / unit), std::lround(place[1] / unit), std::lround(place[2] / unit)};
  };
  std::map<Key, std::size_t> nodes;
  for (std::size_t node = 0; node < space.positions.size(); ++node) nodes[key_of(space.positions[node])] = node;
  std::vector<std::size_t> result;
  result.reserve(mesh.points.size());
  for (const meshes::Point& point : mesh.points) {
    const Key key = key_of(point);
    auto found = nodes.find(key);
    // Rounding may have moved either over the border between two units.
    for (int n = 0; n < 27 && found == nodes.end(); ++n)
      found = nodes.find({key[0] + n % 3 - 1, key[1] + n / 3 % 3 - 1, key[2] + n / 9 - 1});
    assert(found != nodes.end());
    result.push_back(found->second);
  }
  return result;
}

class ImplicitLocomotion final : public LocomotionDynamics {
 public:
  ImplicitLocomotion(const LocomotionStudy& study, const std::atomic<bool>* stop)
      : body_(body_of(study)),
        space_(make_space(study.mesh, study.implicit->degree, 0, MPI_COMM_WORLD)),
        nodes_(nodes_at_points(space_, study.mesh)),
        dynamics_(space_, body_, options_of(study, stop)) {}

  LocomotionOutcome advance_to(double time_s) override {
    const ImplicitReport& report = dynamics_.advance_to(time_s);
    return {report.status, report.reason};
  }
  void set_state(LocomotionState state) override { dynamics_.set_state(std::get<ImplicitState>(std::move(state))); }
  [[nodiscard]] LocomotionState state() const override { return dynamics_.state(); }
  [[nodiscard]] double time_s() const override { return dynamics_.state().time_s; }
  [[nodiscard]] std::size_t steps() const override { return dynamics_.state().steps; }
  [[nodiscard]] bool goes_on_from_any_state() const override { return false; }
  [[nodiscard]] std::string machine_text() const override { return std::string(best_element_kernels().instruction_set); }

  [[nodiscard]] LocomotionRecord record() override {
    LocomotionRecord record;
    record.time_s = dynamics_.state().time_s;
    record.centre_of_mass_m = dynamics_.centre_of_mass_m();
    for (std::size_t p = 0; p < body_.plenum_count; ++p) record.plenum_pressures_Pa.push_back(dynamics_.plenum_pressure_Pa(p));
    record.chamber_volumes_m3 = dynamics_.chamber_volumes_m3();
    record.energies = dynamics_.energies();
    record.ground_force_N = dynamics_.ground_force_N();
    return record;
  }
  [[nodiscard]] std::vector<double> displacements_m() const override { return at_points(dynamics_.state().displacements_m); }
  [[nodiscard]] std::vector<double> velocities_m_per_s() override { return at_points(dynamics_.state().velocities_m_per_s); }

 private:
  [[nodiscard]] std::vector<double> at_points(const std::vector<double>& field) const {
    std::vector<double> result;
    result.reserve(3 * nodes_.size());
    for (const std::size_t node : nodes_)
      for (std::size_t i = 0; i < 3; ++i) result.push_back(field[3 * node + i]);
    return result;
  }

  Body body_;
  Space space_;
  std::vector<std::size_t> nodes_;  ///< at the points of the mesh
  ImplicitDynamics dynamics_;
};

}  // namespace

std::unique_ptr<LocomotionDynamics> make_implicit_locomotion(const LocomotionStudy& study, const std::atomic<bool>* stop) {
  int rank_count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &rank_count);
  if (rank_count > 1) throw io::InputError("implicit locomotion runs on one process, not on " + std::to_string(rank_count));
  return std::make_unique<ImplicitLocomotion>(study, stop);
}

}  // namespace menger::fem
