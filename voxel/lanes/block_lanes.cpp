#include "voxel/lanes/block_lanes.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "voxel/model/actuation.h"

namespace menger::voxel {

namespace {

constexpr auto line_size = static_cast<std::size_t>(line_length);
constexpr auto history_size = static_cast<std::size_t>(history_values);
constexpr auto drive_size = static_cast<std::size_t>(drive_values);
constexpr auto end_size = static_cast<std::size_t>(end_loads);

/// Where the lanes of a pack come from, as numbers pack * lanes + lane in ascending order, or a negative number where from
/// nowhere.
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
BlockLanes<Real>::BlockLanes(EngineOf<Real>& engine, BlockBody body, const LaneKernels<Real>& kernels, int threads)
    : engine_(engine),
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

/// Finds where the histories of the engine's beams stand in lanes.
template <class Real>
void BlockLanes<Real>::find_histories(std::size_t axis) {
  const AxisBeams& inside = block_.beams[axis];
  const auto& pairs = body_.neighbours[axis];
  const auto& faces = body_.faces[axis];
  const AxisBeams& beams = engine_.lattice->beams[axis];
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

/// The number of lanes of a group that have a block.
template <class Real>
std::size_t BlockLanes<Real>::lanes_used(std::size_t group) const {
  return std::min(lanes_, body_.count - group * lanes_);
}

template <class Real>
void BlockLanes<Real>::put() {
  const EngineOf<Real>& engine = engine_;
  const StepData<Real>& d = engine.state_->data;
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
  next_sine_ = d.next_sine;
  next_cosine_ = d.next_cosine;
  for (std::size_t g = 0; g < groups_.size(); ++g) put_spheres(g);
}

template <class Real>
void BlockLanes<Real>::put_histories() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = engine_.state_->data.axis[axis];
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

/// Puts positions again whose origin has moved.
template <class Real>
void BlockLanes<Real>::put_positions() {
  const StepData<Real>& d = engine_.state_->data;
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
  const StepData<Real>& d = engine_.state_->data;
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
  StepData<Real>& d = engine_.state_->data;
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
  d.rate_scale = groups_.front().rate_scale;
}

/// Sets what all groups have in common in the next step, and finds its contacts; or says that there is no next step.
template <class Real>
void BlockLanes<Real>::begin_step() {
  const EngineOf<Real>& engine = engine_;
  done_ = engine.steps == last_step_ || engine.divergence || (stop_ != nullptr && stop_->load(std::memory_order_relaxed));
  if (done_) return;
  may_touch_ = prepare_contacts();
  if (!engine.actuated_) return;
  const DriveAngle next =
      drive_angle(static_cast<double>(engine.steps + 1) * engine.time_step_s, engine.physics.actuation.period_s);
  next_sine_ = static_cast<Real>(next.sine);
  next_cosine_ = static_cast<Real>(next.cosine);
}

template <class Real>
void BlockLanes<Real>::find_joint_loads(Part& part) {
  const bool velocity = engine_.physics.integration.damping == DampingMode::velocity;
  part.strained = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Pairs stand in the order of their lower blocks: a thread finds nearly all of these in its own groups, and so in its cache.
    const auto [first, last] = share(data_.axis[axis].packs, part);
    if (kernels_.joints[velocity][axis](data_, first, last)) part.strained = true;
  }
}

/// Adds up the loads in the order in which a voxel gets those of its own beams, along x, y, z, each by the lower end, and moves
/// the voxels, a group at a time, which stays in the cache for that.
///
/// A voxel on the lower face of its block is the upper end of a beam between blocks before it is the lower end of one inside, and
/// one on the upper face the other way round.
template <class Real>
void BlockLanes<Real>::move_groups(Part& part) {
  const bool velocity = engine_.physics.integration.damping == DampingMode::velocity;
  part.too_fast = false;
  part.largest_displacement2 = 0.0;
  const auto [first, last] = share(groups_.size(), part);
  for (std::size_t g = first; g < last; ++g) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      kernels_.add_joint_loads(data_, axis, 1, g);
      if (kernels_.in_blocks[velocity][axis](groups_[g], static_cast<int>(lanes_used(g)))) part.strained = true;
      kernels_.add_joint_loads(data_, axis, 0, g);
    }
    add_contacts(g);
    groups_[g].next_sine = next_sine_;
    groups_[g].next_cosine = next_cosine_;
    alignas(64) Real largest2[most_lanes] = {};
    const std::uint32_t bits = kernels_.voxels[true][true](groups_[g], largest2);
    for (std::size_t lane = 0; lane < lanes_used(g); ++lane) {
      if (((bits >> lane) & 1U) != 0) part.too_fast = true;
      const auto one = static_cast<double>(largest2[lane]);
      if (one > part.largest_displacement2) part.largest_displacement2 = one;
    }
    put_spheres(g);
  }
}

/// What the engine does at the end of its own step.
template <class Real>
void BlockLanes<Real>::end_step() {
  EngineOf<Real>& engine = engine_;
  std::exception_ptr failure;
  for (Part& part : parts_) {
    if (part.failure) failure = std::exchange(part.failure, nullptr);
  }
  if (failure) std::rethrow_exception(failure);
  bool strained = false;
  bool too_fast = false;
  double largest2 = 0.0;
  for (const Part& part : parts_) {
    strained = strained || part.strained;
    too_fast = too_fast || part.too_fast;
    largest2 = std::max(largest2, part.largest_displacement2);
  }
  if (strained) {
    // The engine looks at beams before voxels have got their next sizes.
    take();
    if (engine.actuated_) {
      const DriveAngle start =
          drive_angle(static_cast<double>(engine.steps) * engine.time_step_s, engine.physics.actuation.period_s);
      engine.state_->set_sizes(start.sine, start.cosine);
    }
    engine.note_strain();
  }
  const double largest_displacement_m = std::sqrt(largest2);
  const auto rate_scale = static_cast<Real>(1.0 / engine.time_step_s);
  if (groups_.front().rate_scale != rate_scale) {  // what all threads read is left alone
    for (LaneData<Real>& group : groups_) group.rate_scale = rate_scale;
  }
  ++engine.steps;
  if (engine.close_pairs_) engine.close_pairs_->moved(largest_displacement_m);
  if (too_fast) {
    take();
    engine.note_speed();
  } else {
    const bool looks = engine.looks_at_origin_after(largest_displacement_m);
    if (looks) take_poses();
    engine.stay_near_origin(largest_displacement_m);
    if (looks) put_positions();
  }
  if (engine.divergence) engine.divergence->time_s = static_cast<double>(engine.steps) * engine.time_step_s;
}

/// What is not shared of a step. Where it throws, the others must be told, or they would wait for ever.
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

/// A thread's share of all steps; what is not shared does whoever comes last.
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
  last_step_ = engine_.steps + count;
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
  } catch (...) {  // no more threads: those that are there would wait for the others for ever
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
