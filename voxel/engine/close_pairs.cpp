#include "voxel/engine/close_pairs.h"

#include <utility>
#include <vector>

namespace menger::voxel {

namespace {

/// Skin of the Verlet list, in voxel edges: the flat optimum between long lists and frequent rebuilds.
constexpr double list_skin_edges = 0.4;

}  // namespace

template <class Real>
ClosePairs<Real>::ClosePairs(CollisionRule rule, double largest_size_m, double edge_m, const StepKernels<Real>& kernels,
                             const KernelOptions& options)
    : list_(std::move(rule), 2.0 * collision_radius_fraction * largest_size_m, list_skin_edges * edge_m),
      search_(kernels),
      largest_size_m_(largest_size_m),
      anew_in_every_step_(options.every_term),
      never_ruled_out_(options.kept_terms().collisions) {}

template <class Real>
void ClosePairs<Real>::tell_drives_apart(const StepData<Real>& d) {
  const auto same = [&](std::size_t a, std::size_t b) {
    return d.size_base[a] == d.size_base[b] && d.size_sine_part[a] == d.size_sine_part[b] &&
           d.size_cosine_part[a] == d.size_cosine_part[b];
  };
  std::vector<std::uint8_t> kind(d.voxels, 0);
  std::size_t other = 0;
  for (std::size_t i = 1; i < d.voxels; ++i) {
    if (same(i, 0)) continue;
    if (other == 0) other = i;
    if (!same(i, other)) return;
    kind[i] = 1;
  }
  of_kind_ = {0, static_cast<std::int32_t>(other)};
  list_.set_kinds(std::move(kind));
}

template <class Real>
bool ClosePairs<Real>::renew(const Real* pose) {
  if (anew_in_every_step_) {
    make(pose);
    return true;
  }
  if (!list_.refresh(pose, line_size)) return false;
  ++counts_.list_rebuilds;
  return true;
}

template <class Real>
void ClosePairs<Real>::make(const Real* pose) {
  list_.build(pose, line_size);
  ++counts_.list_rebuilds;
}

template <class Real>
bool ClosePairs<Real>::may_touch() {
  counts_.pairs_in_list = list_.pairs().size();
  const bool may = never_ruled_out_ || !list_.contact_ruled_out();
  ++(may ? counts_.steps_with_pairs : counts_.steps_skipped);
  return may;
}

template class ClosePairs<double>;
template class ClosePairs<float>;

}  // namespace menger::voxel
