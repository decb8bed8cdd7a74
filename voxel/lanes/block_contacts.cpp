// Contacts between voxels of a body whose blocks are in lanes: threads look at parts of the near pairs, in their order, and a
// group gets the forces of the first part first, so that the order in which a voxel gets its forces is that of the pairs.

#include "voxel/engine/contact_search.h"
#include "voxel/lanes/block_lanes.h"

namespace menger::voxel {

namespace {

constexpr auto line_size = static_cast<std::size_t>(line_length);

}  // namespace

/// Renews what is known of close pairs where it must be. @return whether any pair may touch
template <class Real>
bool BlockLanes<Real>::prepare_contacts() {
  EngineOf<Real>& engine = engine_;
  if (!engine.close_pairs_) return false;
  const VerletList& list = *engine.close_pairs_;
  if (list.bound_used_up()) take_positions();
  if (!engine.looks_at_pairs()) return false;
  if (list_of_spheres_ != list.number()) number_spheres();
  const auto size_of = [&](std::int32_t voxel) {
    return spheres_[4 * static_cast<std::size_t>(sphere_of_[static_cast<std::size_t>(voxel)]) + slot::size];
  };
  engine.contacts_->prepare(list, spheres(), first_.data(), second_.data(), engine.sizes_of_kinds(size_of));
  return true;
}

/// Takes out the positions alone, which the list of close pairs is made of.
template <class Real>
void BlockLanes<Real>::take_positions() {
  const StepData<Real>& d = engine_.state_->data;
  for (std::size_t voxel = 0; voxel < sphere_of_.size(); ++voxel) {
    const Real* from = spheres_.data() + 4 * static_cast<std::size_t>(sphere_of_[voxel]);
    for (std::size_t axis = 0; axis < 3; ++axis) d.pose[line_size * voxel + axis] = from[axis];
  }
}

/// Names the spheres of the close pairs.
template <class Real>
void BlockLanes<Real>::number_spheres() {
  const VerletList& list = *engine_.close_pairs_;
  const auto number = [&](const std::vector<std::int32_t>& voxels, std::vector<std::int32_t>& spheres) {
    spheres.clear();
    for (const std::int32_t voxel : voxels) spheres.push_back(sphere_of_[static_cast<std::size_t>(voxel)]);
  };
  number(list.first(), first_);
  number(list.second(), second_);
  list_of_spheres_ = list.number();
}

template <class Real>
void BlockLanes<Real>::put_spheres(std::size_t group) {
  if (engine_.close_pairs_) kernels_.put_spheres(groups_[group], spheres_.data() + 4 * group * places_ * lanes_);
}

/// Finds the contact forces of a part's share of the near pairs.
template <class Real>
void BlockLanes<Real>::find_contacts(Part& part) {
  for (std::vector<Contact>& of_group : part.contacts) of_group.clear();
  if (!may_touch_) return;
  const auto sphere = [&](std::int32_t voxel) {
    const Real* values = spheres_.data() + 4 * static_cast<std::size_t>(sphere_of_[static_cast<std::size_t>(voxel)]);
    return std::array<Real, 4>{values[slot::x], values[slot::y], values[slot::z], values[slot::size]};
  };
  const auto line_of = [&](std::int32_t voxel) { return line_of_[static_cast<std::size_t>(voxel)]; };
  const StepData<Real>& d = engine_.state_->data;
  const auto end = [&](std::int32_t voxel) {
    const Real* motion = motion_.data() + line_of(voxel);
    const Vector3<Real> momentum{motion[slot::px * lanes_], motion[slot::py * lanes_], motion[slot::pz * lanes_]};
    return ContactEnd<Real>{d.voxel.inverse_mass * momentum, d.voxel.floor.stiffness, d.voxel.floor.damping};
  };
  const auto add = [&](std::int32_t voxel, const Vector3<Real>& force) {
    const auto group = static_cast<std::size_t>(body_.block_of[static_cast<std::size_t>(voxel)]) / lanes_;
    part.contacts[group].push_back({line_of(voxel), force});
  };
  const ContactSearch<Real>& search = *engine_.contacts_;
  const auto [first, last] = share(search.near_count(), part);
  add_contact_loads<Real>(search.touching(spheres(), first, last, part.touching), engine_.close_pairs_->pairs(), sphere, end,
                          add);
}

/// Adds the contact forces on a group to its loads.
template <class Real>
void BlockLanes<Real>::add_contacts(std::size_t group) {
  for (const Part& part : parts_) {
    for (const Contact& contact : part.contacts[group]) {
      Real* load = load_.data() + contact.at;
      load[slot::fx * lanes_] += contact.force.x;
      load[slot::fy * lanes_] += contact.force.y;
      load[slot::fz * lanes_] += contact.force.z;
    }
  }
}

template bool BlockLanes<double>::prepare_contacts();
template bool BlockLanes<float>::prepare_contacts();
template void BlockLanes<double>::put_spheres(std::size_t);
template void BlockLanes<float>::put_spheres(std::size_t);
template void BlockLanes<double>::find_contacts(Part&);
template void BlockLanes<float>::find_contacts(Part&);
template void BlockLanes<double>::add_contacts(std::size_t);
template void BlockLanes<float>::add_contacts(std::size_t);

}  // namespace menger::voxel
