#include "voxel/lanes/block_lanes.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace menger::voxel {

namespace {

constexpr auto end_size = static_cast<std::size_t>(end_loads);

/// Builds a pack from lanes of other packs. @param origins per lane: pack * lanes + lane of its origin, ascending; negative for a
/// lane without origin
template <class Real>
LaneMoves<Real> moves_of(const std::vector<std::int32_t>& origins) {
  const std::size_t lanes = origins.size();
  LaneMoves<Real> moves;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if (origins[lane] < 0) continue;
    const auto pack = static_cast<std::int32_t>(static_cast<std::size_t>(origins[lane]) / lanes);
    if (moves.sources == 0 || moves.source[moves.sources - 1] != pack) moves.source[moves.sources++] = pack;
    const auto source = static_cast<std::size_t>(moves.sources - 1);
    const std::size_t within = static_cast<std::size_t>(origins[lane]) % lanes;
    moves.from[source / 2][lane] = static_cast<typename LaneMoves<Real>::Index>(within + (source % 2) * lanes);
    moves.comes[source / 2][lane] = Real(1);
    moves.any[lane] = Real(1);
  }
  if (moves.sources % 2 == 1) moves.source[moves.sources] = moves.source[moves.sources - 1];
  return moves;
}

}  // namespace

template <class Real>
BlockLanes<Real>::BlockLanes(MovingBody<Real>& moving, BlockBody body, const LaneKernels<Real>& kernels, int threads)
    : moving_(moving),
      body_(std::move(body)),
      block_(body_.block),
      kernels_(kernels),
      lanes_(static_cast<std::size_t>(kernels.lanes)),
      places_(body_.places()),
      slots_((body_.count + lanes_ - 1) / lanes_ * lanes_),
      barrier_(threads) {
  set_threads(threads);
  allocate();
  for (std::size_t axis = 0; axis < 3; ++axis) join(axis);
}

template <class Real>
void BlockLanes<Real>::set_threads(int threads) {
  barrier_.set_threads(threads);
  parts_.resize(static_cast<std::size_t>(threads));
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    parts_[i].number = i;
    parts_[i].contacts.resize(slots_ / lanes_);
  }
}

template <class Real>
void BlockLanes<Real>::allocate() {
  const std::size_t voxels = slots_ * places_;
  pose_.assign(line_size * voxels, Real(0));
  motion_.assign(line_size * voxels, Real(0));
  load_.assign(line_size * voxels, Real(0));
  residual_.assign(3 * voxels, Real(0));
  drive_.assign(drive_size * voxels, Real(0));
  spheres_.assign(4 * voxels, Real(0));
  for (std::size_t i = 0; i < body_.voxel.size(); ++i) {
    const auto block = static_cast<std::size_t>(body_.block_of[i]);
    const auto place = static_cast<std::size_t>(body_.place[i]);
    line_of_.push_back(at(block, place, line_size, 0));
    sphere_of_.push_back(static_cast<std::int32_t>(at(block, place, 1, 0)));
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    history_[axis].assign(history_size * block_.beams[axis].lower.size() * slots_, Real(0));

  groups_.resize(slots_ / lanes_);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    LaneData<Real>& group = groups_[g];
    const std::size_t first = g * lanes_ * places_;
    group.voxels = places_;
    group.pose = pose_.data() + line_size * first;
    group.motion = motion_.data() + line_size * first;
    group.load = load_.data() + line_size * first;
    group.position_residual = residual_.data() + 3 * first;
    group.drive = drive_.data() + drive_size * first;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const AxisBeams& beams = block_.beams[axis];
      group.axis[axis] = {.count = beams.lower.size(),
                          .lower = beams.lower.data(),
                          .upper = beams.upper.data(),
                          .history = history_[axis].data() + history_size * beams.lower.size() * lanes_ * g};
    }
  }
  data_.groups = groups_.data();
  data_.group_stride = line_size * places_ * lanes_;
}

/// Lays out the beams between blocks along an axis.
template <class Real>
void BlockLanes<Real>::join(std::size_t axis) {
  const auto& pairs = body_.neighbours[axis];
  for (std::size_t first = 0; first < pairs.size(); first += lanes_) {
    std::vector<std::int32_t> lower;
    std::vector<std::int32_t> upper;
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      const auto& pair = pairs[std::min(first + lane, pairs.size() - 1)];
      lower.push_back(pair.first);
      upper.push_back(pair.second);
    }
    lower_blocks_[axis].push_back(moves_of<Real>(lower));
    upper_blocks_[axis].push_back(moves_of<Real>(upper));
  }
  std::array<std::vector<std::int32_t>, 2> pair_of;  // per end and block
  pair_of.fill(std::vector<std::int32_t>(slots_, -1));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pair_of[0][static_cast<std::size_t>(pairs[i].first)] = static_cast<std::int32_t>(i);
    pair_of[1][static_cast<std::size_t>(pairs[i].second)] = static_cast<std::int32_t>(i);
  }
  for (std::size_t end = 0; end < 2; ++end) {
    for (std::size_t first = 0; first < slots_; first += lanes_) {
      const auto of_group = pair_of[end].begin() + static_cast<std::ptrdiff_t>(first);
      to_blocks_[axis][end].push_back(moves_of<Real>({of_group, of_group + static_cast<std::ptrdiff_t>(lanes_)}));
    }
  }
  for (const auto& [lower, upper] : body_.faces[axis]) {
    face_lower_[axis].push_back(lower);
    face_upper_[axis].push_back(upper);
  }
  const std::size_t packs = lower_blocks_[axis].size();
  const std::size_t beams = body_.faces[axis].size() * packs;
  joint_history_[axis].assign(history_size * beams * lanes_, Real(0));
  joint_loads_[axis].assign(2 * end_size * beams * lanes_, Real(0));
  data_.axis[axis] = {.faces = body_.faces[axis].size(),
                      .lower = face_lower_[axis].data(),
                      .upper = face_upper_[axis].data(),
                      .packs = packs,
                      .lower_block = lower_blocks_[axis].data(),
                      .upper_block = upper_blocks_[axis].data(),
                      .history = joint_history_[axis].data(),
                      .loads = joint_loads_[axis].data()};
  for (std::size_t end = 0; end < 2; ++end) data_.axis[axis].to_blocks[end] = to_blocks_[axis][end].data();
  find_histories(axis);
}

/// Finds the positions of the histories of the body's beams in the lanes.
template <class Real>
void BlockLanes<Real>::find_histories(std::size_t axis) {
  const AxisBeams& inside = block_.beams[axis];
  const auto& pairs = body_.neighbours[axis];
  const auto& faces = body_.faces[axis];
  const AxisBeams& beams = moving_.body().lattice.beams[axis];
  for (std::size_t i = 0; i < beams.lower.size(); ++i) {
    const auto lower = static_cast<std::size_t>(beams.lower[i]);
    const auto upper = static_cast<std::size_t>(beams.upper[i]);
    const auto block = static_cast<std::size_t>(body_.block_of[lower]);
    if (body_.block_of[lower] == body_.block_of[upper]) {
      const auto found = std::lower_bound(inside.lower.begin(), inside.lower.end(), body_.place[lower]);
      const auto beam = static_cast<std::size_t>(found - inside.lower.begin());
      const std::size_t pack = block / lanes_ * inside.lower.size() + beam;
      remembered_[axis].push_back(history_[axis].data() + history_size * lanes_ * pack + block % lanes_);
      continue;
    }
    const auto pair = static_cast<std::size_t>(
        std::lower_bound(pairs.begin(), pairs.end(), std::pair(body_.block_of[lower], body_.block_of[upper])) - pairs.begin());
    const auto face = static_cast<std::size_t>(
        std::find(faces.begin(), faces.end(), std::pair(body_.place[lower], body_.place[upper])) - faces.begin());
    const std::size_t pack = face * data_.axis[axis].packs + pair / lanes_;
    Real* history = joint_history_[axis].data() + history_size * lanes_ * pack + pair % lanes_;
    remembered_[axis].push_back(history);
    if (pair + 1 != pairs.size()) continue;
    for (std::size_t lane = pair % lanes_ + 1; lane < lanes_; ++lane)
      repeated_[axis].emplace_back(history - pair % lanes_ + lane, history);
  }
}

/// The number of lanes of a group that hold a block.
template <class Real>
std::size_t BlockLanes<Real>::lanes_used(std::size_t group) const {
  return std::min(lanes_, body_.count - group * lanes_);
}

template <class Real>
void BlockLanes<Real>::put() {
  const StepData<Real>& d = moving_.data();
  std::fill(load_.begin(), load_.end(), Real(0));
  for (std::size_t slot = 0; slot < slots_; ++slot) {
    const std::size_t block = slot < body_.count ? slot : 0;
    for (std::size_t place = 0; place < places_; ++place) {
      const auto voxel = static_cast<std::size_t>(body_.voxel[block * places_ + place]);
      for (std::size_t k = 0; k < line_size; ++k) {
        pose_[at(slot, place, line_size, k)] = d.pose[line_size * voxel + k];
        motion_[at(slot, place, line_size, k)] = d.motion[line_size * voxel + k];
      }
      for (std::size_t k = 0; k < 3; ++k) residual_[at(slot, place, 3, k)] = d.position_residual[line_size * voxel + k];
      drive_[at(slot, place, drive_size, 0)] = d.size_base[voxel];
      drive_[at(slot, place, drive_size, 1)] = d.size_sine_part[voxel];
      drive_[at(slot, place, drive_size, 2)] = d.size_cosine_part[voxel];
    }
  }
  put_histories();
  for (LaneData<Real>& group : groups_) {
    const StepConstants<Real>& constants = d;
    static_cast<StepConstants<Real>&>(group) = constants;
    group.voxel = d.voxel;
    group.beam = d.beam;
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      group.floor_depth[lane] = d.floor_depth;
      group.displacement_limit2[lane] = d.displacement_limit2;
    }
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) put_spheres(g);
}

template <class Real>
void BlockLanes<Real>::put_histories() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = moving_.data().axis[axis];
    for (std::size_t i = 0; i < remembered_[axis].size(); ++i) {
      for (std::size_t k = 0; k < history_size; ++k) remembered_[axis][i][k * lanes_] = beams.history[k * beams.count + i];
    }
    for (const auto& [copy, original] : repeated_[axis]) {
      for (std::size_t k = 0; k < history_size; ++k) copy[k * lanes_] = original[k * lanes_];
    }
    const std::size_t packs = history_size * block_.beams[axis].lower.size();
    for (std::size_t slot = body_.count; slot < slots_; ++slot) {
      for (std::size_t pack = 0; pack < packs; ++pack)
        history_[axis][(slot / lanes_ * packs + pack) * lanes_ + slot % lanes_] = history_[axis][pack * lanes_];
    }
  }
}

/// Writes the positions again after their origin has moved.
template <class Real>
void BlockLanes<Real>::put_positions() {
  const StepData<Real>& d = moving_.data();
  for (std::size_t block = 0; block < body_.count; ++block) {
    for (std::size_t place = 0; place < places_; ++place) {
      const auto voxel = static_cast<std::size_t>(body_.voxel[block * places_ + place]);
      for (std::size_t k = 0; k < 3; ++k) {
        pose_[at(block, place, line_size, k)] = d.pose[line_size * voxel + k];
        residual_[at(block, place, 3, k)] = d.position_residual[line_size * voxel + k];
      }
    }
  }
  for (LaneData<Real>& group : groups_) std::fill_n(group.floor_depth, lanes_, d.floor_depth);
  for (std::size_t g = 0; g < groups_.size(); ++g) put_spheres(g);
}

template <class Real>
void BlockLanes<Real>::take_poses() {
  const StepData<Real>& d = moving_.data();
  for (std::size_t block = 0; block < body_.count; ++block) {
    for (std::size_t place = 0; place < places_; ++place) {
      const auto voxel = static_cast<std::size_t>(body_.voxel[block * places_ + place]);
      for (std::size_t k = 0; k < line_size; ++k) d.pose[line_size * voxel + k] = pose_[at(block, place, line_size, k)];
      for (std::size_t k = 0; k < 3; ++k) d.position_residual[line_size * voxel + k] = residual_[at(block, place, 3, k)];
    }
  }
}

template <class Real>
void BlockLanes<Real>::take() {
  take_poses();
  StepData<Real>& d = moving_.data();
  for (std::size_t block = 0; block < body_.count; ++block) {
    for (std::size_t place = 0; place < places_; ++place) {
      const auto voxel = static_cast<std::size_t>(body_.voxel[block * places_ + place]);
      for (std::size_t k = 0; k < line_size; ++k) d.motion[line_size * voxel + k] = motion_[at(block, place, line_size, k)];
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = d.axis[axis];
    for (std::size_t i = 0; i < remembered_[axis].size(); ++i) {
      for (std::size_t k = 0; k < history_size; ++k) beams.history[k * beams.count + i] = remembered_[axis][i][k * lanes_];
    }
  }
}

/// Sets what all groups share in the next step and prepares its contacts, or ends the run if there is no next step.
template <class Real>
void BlockLanes<Real>::begin_step() {
  const RunRecord& record = moving_.record();
  done_ = record.steps == last_step_ || record.divergence || (stop_ != nullptr && stop_->load(std::memory_order_relaxed));
  if (done_) return;
  moving_.begin_step();
  may_touch_ = prepare_contacts();
}

/// Updates the list of close pairs where necessary. @return whether any pair may touch
template <class Real>
bool BlockLanes<Real>::prepare_contacts() {
  ClosePairs<Real>* pairs = moving_.close_pairs();
  if (pairs == nullptr) return false;
  if (pairs->looks_at_positions()) take_positions();
  pairs->renew(moving_.data().pose);
  if (!pairs->may_touch()) return false;
  if (list_of_spheres_ != pairs->list().number()) number_spheres();
  const auto size_of = [&](std::int32_t voxel) {
    return spheres_[4 * static_cast<std::size_t>(sphere_of_[static_cast<std::size_t>(voxel)]) + slot::size];
  };
  pairs->search(spheres(), first_.data(), second_.data(), size_of);
  return true;
}

/// Copies only the positions to the body; the list of close pairs is made from them.
template <class Real>
void BlockLanes<Real>::take_positions() {
  const StepData<Real>& d = moving_.data();
  for (std::size_t voxel = 0; voxel < sphere_of_.size(); ++voxel) {
    const Real* from = spheres_.data() + 4 * static_cast<std::size_t>(sphere_of_[voxel]);
    for (std::size_t axis = 0; axis < 3; ++axis) d.pose[line_size * voxel + axis] = from[axis];
  }
}

/// Finds the indices of the spheres of the close pairs.
template <class Real>
void BlockLanes<Real>::number_spheres() {
  const VerletList& list = moving_.close_pairs()->list();
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
  if (moving_.close_pairs() != nullptr) kernels_.put_spheres(groups_[group], spheres_.data() + 4 * group * places_ * lanes_);
}

/// Finds the contact forces of a part's share of the near pairs. Parts have their shares in the order of the pairs.
template <class Real>
void BlockLanes<Real>::find_contacts(Part& part) {
  for (std::vector<Contact>& of_group : part.contacts) of_group.clear();
  if (!may_touch_) return;
  const auto sphere = [&](std::int32_t voxel) {
    const Real* values = spheres_.data() + 4 * static_cast<std::size_t>(sphere_of_[static_cast<std::size_t>(voxel)]);
    return std::array<Real, 4>{values[slot::x], values[slot::y], values[slot::z], values[slot::size]};
  };
  const auto line_of = [&](std::int32_t voxel) { return line_of_[static_cast<std::size_t>(voxel)]; };
  const StepData<Real>& d = moving_.data();
  const auto end = [&](std::int32_t voxel) {
    const Real* motion = motion_.data() + line_of(voxel);
    const Vector3<Real> momentum{motion[slot::px * lanes_], motion[slot::py * lanes_], motion[slot::pz * lanes_]};
    return ContactEnd<Real>{d.voxel.inverse_mass * momentum, d.voxel.floor.stiffness, d.voxel.floor.damping};
  };
  const auto add = [&](std::int32_t voxel, const Vector3<Real>& force) {
    const auto group = static_cast<std::size_t>(body_.block_of[static_cast<std::size_t>(voxel)]) / lanes_;
    part.contacts[group].push_back({line_of(voxel), force});
  };
  const ClosePairs<Real>& pairs = *moving_.close_pairs();
  const ContactSearch<Real>& search = pairs.search();
  const auto [first, last] = share(search.near_count(), part);
  add_contact_loads<Real>(search.touching(spheres(), first, last, part.touching), pairs.list().pairs(), sphere, end, add);
}

/// Adds the contact forces on a group to its loads, part by part. So a voxel gets its forces in the order of the pairs.
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

template <class Real>
void BlockLanes<Real>::find_joint_loads(Part& part) {
  const bool velocity = moving_.body().physics.integration.damping == DampingMode::velocity;
  part.strained = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Pairs of blocks are sorted by their lower block. A thread finds nearly all of these in its own groups, and so in its cache.
    const auto [first, last] = share(data_.axis[axis].packs, part);
    if (kernels_.joints[velocity][axis](data_, first, last)) part.strained = true;
  }
}

/// Adds up the loads and moves the voxels, one group at a time, which stays in the cache meanwhile.
///
/// The order of the sum is that of a voxel's own beams: along x, y, z, and along each axis by the lower end of the beam. A voxel
/// on the lower face of its block is first the upper end of a beam between blocks, then the lower end of one inside. On the upper
/// face it is the other way round.
template <class Real>
void BlockLanes<Real>::move_groups(Part& part) {
  const bool velocity = moving_.body().physics.integration.damping == DampingMode::velocity;
  const StepConstants<Real>& constants = moving_.data();
  part.seen = {};
  const auto [first, last] = share(groups_.size(), part);
  for (std::size_t g = first; g < last; ++g) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      kernels_.add_joint_loads(data_, axis, 1, g);
      if (kernels_.in_blocks[velocity][axis](groups_[g], static_cast<int>(lanes_used(g)))) part.strained = true;
      kernels_.add_joint_loads(data_, axis, 0, g);
    }
    add_contacts(g);
    groups_[g].next_sine = constants.next_sine;
    groups_[g].next_cosine = constants.next_cosine;
    alignas(64) Real largest2[most_lanes] = {};
    const std::uint32_t bits = kernels_.voxels[true][true](groups_[g], largest2);
    for (std::size_t lane = 0; lane < lanes_used(g); ++lane) {
      if (((bits >> lane) & 1U) != 0) part.seen.out_of_range = true;
      part.seen.largest_displacement2 = std::max(part.seen.largest_displacement2, static_cast<double>(largest2[lane]));
    }
    put_spheres(g);
  }
}

/// Combines the results of all threads and ends the step.
template <class Real>
void BlockLanes<Real>::end_step() {
  std::exception_ptr failure;
  for (Part& part : parts_) {
    if (part.failure) failure = std::exchange(part.failure, nullptr);
  }
  if (failure) std::rethrow_exception(failure);
  bool strained = false;
  VoxelSweep seen;
  for (const Part& part : parts_) {
    strained = strained || part.strained;
    seen.out_of_range = seen.out_of_range || part.seen.out_of_range;
    seen.largest_displacement2 = std::max(seen.largest_displacement2, part.seen.largest_displacement2);
  }
  if (strained) {
    take();
    moving_.check_strains_after_move(true);
  }
  moving_.end_step(seen, Lanes{*this});
  const Real rate_scale = moving_.data().rate_scale;
  if (groups_.front().rate_scale == rate_scale) return;  // Do not write what all threads read.
  for (LaneData<Real>& group : groups_) group.rate_scale = rate_scale;
}

/// Does the part of a step that is not shared. An exception is kept and ends all threads, which would otherwise wait for ever.
template <class Real>
void BlockLanes<Real>::do_alone(void (BlockLanes::*work)()) {
  if (failure_) return;
  try {
    (this->*work)();
  } catch (...) {
    failure_ = std::current_exception();
  }
  done_ = done_ || failure_;
}

/// Does a thread's share of all steps. The last thread to arrive does the work that is not shared.
template <class Real>
void BlockLanes<Real>::do_part(Part& part) {
  barrier_.meet([this] { do_alone(&BlockLanes::begin_step); });
  while (!done_) {
    try {
      find_contacts(part);
    } catch (...) {
      part.failure = std::current_exception();
    }
    find_joint_loads(part);
    barrier_.meet();
    move_groups(part);
    barrier_.meet([this] {
      do_alone(&BlockLanes::end_step);
      do_alone(&BlockLanes::begin_step);
    });
  }
}

template <class Real>
void BlockLanes<Real>::advance(std::uint64_t count, const std::atomic<bool>* stop) {
  put();
  last_step_ = moving_.record().steps + count;
  stop_ = stop;
  enum class Start { not_yet, now, never };
  std::atomic<Start> start{Start::not_yet};
  const auto begin = [&start](Start when) {
    start = when;
    start.notify_all();
  };
  std::vector<std::jthread> others;
  try {
    for (std::size_t i = 1; i < parts_.size(); ++i) {
      others.emplace_back([this, &start, i] {
        start.wait(Start::not_yet);
        if (start == Start::now) do_part(parts_[i]);
      });
    }
  } catch (...) {  // No more threads can be started: release those that exist, or they would wait for ever.
    begin(Start::never);
    throw;
  }
  begin(Start::now);
  do_part(parts_.front());
  others.clear();  // joins them
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  take();
}

template class BlockLanes<double>;
template class BlockLanes<float>;

}  // namespace menger::voxel
