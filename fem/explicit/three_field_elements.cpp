#include "fem/explicit/three_field_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace menger::fem {
namespace {

class ThreeFieldForces final : public ElementForces {
 public:
  explicit ThreeFieldForces(const ThreeFieldElements& elements)
      : elements_(elements), slots_(24 * elements.boxes().width() * elements.boxes().batch_count()) {}

  void place(const NodalMotion& motion, const BlockLoop&) override { motion_ = motion; }
  void follow(IndexRange) override {}
  void press(std::span<const double>) override {}
  [[nodiscard]] std::size_t batch_count() const override { return elements_.boxes().batch_count(); }

  ForcesOutcome compute(IndexRange batches, BranchNumbers& branches, double relaxed_s) override {
    AlignedNumbers& tensors = std::get<AlignedNumbers>(branches);
    const BranchTensors branch{tensors.empty() ? nullptr : tensors.data(), relaxed_s, elements_.sets_apart()};
    const ElementsOutcome outcome = elements_.forces(motion_, batches, branch, slots_.data());
    return {.has_failed = !(outcome.smallest_ratio > 0.0), .dissipated_W = outcome.dissipated_W, .relaxed_J = outcome.relaxed_J};
  }

  void sum(IndexRange nodes, double* forces_N) const override {
    for (std::size_t node = nodes.begin; node < nodes.end; ++node)
      for (const double force : elements_.boxes().slots().sum(slots_.data(), node)) *forces_N++ = force;
  }

  [[nodiscard]] PressedVolumes pressed_volumes() const override {
    const std::vector<double> none(elements_.plenum_count(), 0.0);
    return {none, none};
  }

 private:
  const ThreeFieldElements& elements_;
  NodalMotion motion_;
  AlignedNumbers slots_;
};

}  // namespace

ThreeFieldElements::ThreeFieldElements(const meshes::HexahedralMesh& mesh, std::vector<ExplicitRegion> regions,
                                       const ExplicitKernels& kernels)
    : kernels_(kernels),
      regions_(std::move(regions)),
      boxes_(mesh, kernels.width),
      points_(mesh.points),
      plenum_count_(mesh.plenum_names.size()) {
  for (ExplicitRegion& region : regions_) region.material.branches = acting(region.material.branches);
}

std::string ThreeFieldElements::text() const { return std::string(kernels_.instruction_set); }

double ThreeFieldElements::contact_modulus_Pa() const {
  double largest = 0.0;
  for (const ExplicitRegion& region : regions_)
    largest = std::max(largest, std::visit([](const auto& law) { return law.bulk_modulus_Pa; }, region.material.volume));
  return largest;
}

std::unique_ptr<ElementForces> ThreeFieldElements::make_forces() const { return std::make_unique<ThreeFieldForces>(*this); }

BranchNumbers ThreeFieldElements::branches_at_rest(std::span<const double> displacements_m) const {
  std::size_t sets = 0;
  for (const ExplicitRegion& region : regions_) sets = std::max(sets, branch_set_count(region.material.branches.size()));
  if (sets == 0) return AlignedNumbers{};
  const std::size_t width = boxes_.width();
  AlignedNumbers tensors(sets * sets_apart(), 0.0);
  for (std::size_t n = 0; n < tensors.size(); ++n)
    if (n / width % 6 < 3) tensors[n] = 1.0;  // any positive tensor will do: it relaxes completely
  AlignedNumbers slots(24 * width * boxes_.batch_count());
  forces({displacements_m.data()}, {0, boxes_.batch_count()},
         {tensors.data(), std::numeric_limits<double>::infinity(), sets_apart()}, slots.data());
  return tensors;
}

ElementsOutcome ThreeFieldElements::forces(const NodalMotion& motion, IndexRange batches, const BranchTensors& branch,
                                           double* slots_N) const {
  ElementsOutcome outcome;
  for (const BoxGroup& group : boxes_.groups()) {
    const std::size_t first = std::max(batches.begin, group.first_batch);
    const std::size_t end = std::min(batches.end, group.first_batch + group.batch_count);
    if (first >= end) continue;
    BranchTensors own = branch;
    if (own.values != nullptr) own.values += branch_position(first);
    const ElementsOutcome part = kernels_.forces(regions_[group.region].material, boxes_.batches(first, end - first), motion, own,
                                                 slots_N + 24 * boxes_.width() * first);
    outcome.smallest_ratio = std::min(outcome.smallest_ratio, part.smallest_ratio);
    outcome.dissipated_W += part.dissipated_W;
    outcome.relaxed_J += part.relaxed_J;
  }
  return outcome;
}

ThreeFieldElements::LaneEnergies ThreeFieldElements::lane_energies(std::span<const double> displacements_m,
                                                                   const AlignedNumbers& branch) const {
  LaneEnergies result;
  result.energies_J.resize(boxes_.batch_count() * boxes_.width());
  result.smallest_ratios.resize(result.energies_J.size());
  for (const BoxGroup& group : boxes_.groups()) {
    const std::size_t first = group.first_batch * boxes_.width();
    kernels_.energies(regions_[group.region].material, boxes_.batches(group.first_batch, group.batch_count),
                      {displacements_m.data()}, branch.empty() ? nullptr : branch.data() + branch_position(group.first_batch),
                      sets_apart(), result.energies_J.data() + first, result.smallest_ratios.data() + first);
  }
  return result;
}

double ThreeFieldElements::strain_energy_J(std::span<const double> displacements_m, const BranchNumbers& branches) const {
  const AlignedNumbers lanes = lane_energies(displacements_m, std::get<AlignedNumbers>(branches)).energies_J;
  return std::accumulate(lanes.begin(), lanes.end(), 0.0);
}

std::optional<FailedElement> ThreeFieldElements::failed_element(std::span<const double> displacements_m) const {
  const AlignedNumbers ratios = lane_energies(displacements_m, {}).smallest_ratios;
  for (std::size_t lane = 0; lane < ratios.size(); ++lane) {
    if (ratios[lane] > 0.0) continue;
    FailedElement failed{boxes_.element(lane), points_[boxes_.first_components(lane)[0] / 3], true};
    for (const std::uint32_t component : boxes_.first_components(lane))
      for (std::size_t i = 0; i < 3; ++i) failed.is_finite = failed.is_finite && std::isfinite(displacements_m[component + i]);
    return failed;
  }
  return std::nullopt;
}

}  // namespace menger::fem
