#include "voxel/lanes/lane_group.h"

#include <cmath>
#include <utility>

#include "voxel/model/actuation.h"

namespace menger::voxel {

namespace {

constexpr auto line_size = static_cast<std::size_t>(line_length);

}  // namespace

template <class Real>
Lattice LaneGroup<Real>::shared_lattice(const std::vector<EngineOf<Real>*>& robots) {
  const std::array<int, 3>& grid = robots.front()->lattice->grid;
  meshes::Polycube all(grid[0], grid[1], grid[2]);
  for (const EngineOf<Real>* robot : robots) {
    for (const meshes::CellIndex& cell : robot->lattice->cells) all.set(cell, 1);
  }
  return Lattice(all);
}

template <class Real>
LaneGroup<Real>::LaneGroup(const std::vector<EngineOf<Real>*>& robots, const LaneKernels<Real>& kernels)
    : lattice_(shared_lattice(robots)),
      state_(lattice_, robots.front()->cell_edge_m, kernels.lanes),
      lanes_(kernels.lanes),
      steps_(robots.front()->steps),
      in_lanes_(robots.size()) {
  for (EngineOf<Real>* engine : robots) {
    const int lane = static_cast<int>(robots_.size());
    robots_.push_back({engine, LanePlaces(lattice_, *engine->lattice)});
    state_.put(lane, engine->state_->data, robots_.back().places);
    collide_ = collide_ || engine->close_pairs_ != nullptr;
    pairs_of_.push_back(lane);
  }
  for (int lane = static_cast<int>(robots_.size()); lane < lanes_; ++lane) {
    const int twin = lane % static_cast<int>(robots_.size());
    state_.copy_lane(twin, lane);
    pairs_of_.push_back(twin);
  }
  const StepConstants<Real>& constants = robots.front()->state_->data;
  static_cast<StepConstants<Real>&>(state_.data) = constants;
  choose_kernels(kernels);
  pairs_changed_ = collide_;
}

template <class Real>
void LaneGroup<Real>::choose_kernels(const LaneKernels<Real>& kernels) {
  const EngineOf<Real>& first = *robots_.front().engine;
  const bool same_materials = first.physics.materials[0] == first.physics.materials[1];
  bool uniform = true;
  bool complete = true;
  for (const Robot& robot : robots_) {
    const bool like_first = same_materials || robot.engine->lattice->material.front() == first.lattice->material.front();
    uniform = uniform && like_first && robot.engine->state_->uniform();
    complete = complete && robot.places.voxel.size() == lattice_.voxel_count();
  }
  state_.data.voxel = first.state_->data.voxel;
  state_.data.beam = first.state_->data.beam;
  beams_ = kernels.beams[first.physics.integration.damping == DampingMode::velocity][uniform][complete];
  voxels_ = kernels.voxels[uniform][complete];
  pairs_ = kernels.pairs[uniform];
}

template <class Real>
void LaneGroup<Real>::renew_pairs() {
  std::vector<typename LaneState<Real>::Pairs> of_robots(robots_.size());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Robot& robot = robots_[i];
    if (!robot.in_lane || !robot.engine->close_pairs_) continue;
    const auto place = [&](std::int32_t voxel) {
      return static_cast<std::int32_t>(robot.places.voxel[static_cast<std::size_t>(voxel)]);
    };
    for (const auto& [first, second] : robot.engine->close_pairs_->pairs())
      of_robots[i].emplace_back(place(first), place(second));
  }
  std::vector<typename LaneState<Real>::Pairs> of_lanes;
  for (const int robot : pairs_of_) of_lanes.push_back(of_robots[static_cast<std::size_t>(robot)]);
  state_.set_pairs(of_lanes);
  pairs_changed_ = false;
}

/// One list that is used up makes all others anew with it: they would follow one by one, and each time the lanes' list with them.
template <class Real>
void LaneGroup<Real>::add_contacts() {
  bool anew = false;
  const auto with_pairs = [&](const auto& act) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (robots_[i].in_lane && robots_[i].engine->close_pairs_) act(static_cast<int>(i), *robots_[i].engine);
    }
  };
  with_pairs([&](int lane, EngineOf<Real>& engine) {
    if (!engine.close_pairs_->bound_used_up()) return;
    StepData<Real>& d = engine.state_->data;
    state_.take_poses(lane, d, robots_[static_cast<std::size_t>(lane)].places);
    if (engine.close_pairs_->refresh(d.pose, line_size)) anew = true;
  });
  if (anew) {
    with_pairs([&](int lane, EngineOf<Real>& engine) {
      StepData<Real>& d = engine.state_->data;
      state_.take_poses(lane, d, robots_[static_cast<std::size_t>(lane)].places);
      engine.close_pairs_->build(d.pose, line_size);
      ++engine.collision_counts.list_rebuilds;
    });
  }
  if (anew || pairs_changed_) renew_pairs();
  bool ruled_out = true;
  with_pairs([&](int, EngineOf<Real>& engine) {
    const bool out = engine.close_pairs_->contact_ruled_out();
    engine.collision_counts.pairs_in_list = engine.close_pairs_->pairs().size();
    ++(out ? engine.collision_counts.steps_skipped : engine.collision_counts.steps_with_pairs);
    ruled_out = ruled_out && out;
  });
  if (!ruled_out) pairs_(state_.data);
}

template <class Real>
void LaneGroup<Real>::step() {
  const EngineOf<Real>& first = *robots_.front().engine;
  const auto bit = [](std::uint32_t bits, std::size_t lane) { return ((bits >> lane) & 1U) != 0; };
  if (first.actuated_) {
    const DriveAngle next = drive_angle(static_cast<double>(steps_ + 1) * first.time_step_s, first.physics.actuation.period_s);
    state_.data.next_sine = static_cast<Real>(next.sine);
    state_.data.next_cosine = static_cast<Real>(next.cosine);
  }
  const std::uint32_t strained = beams_(state_.data);
  for (std::size_t lane = 0; strained != 0 && lane < robots_.size(); ++lane) {
    if (!bit(strained, lane) || !robots_[lane].in_lane) continue;
    state_.take(static_cast<int>(lane), robots_[lane].engine->state_->data, robots_[lane].places);
    robots_[lane].engine->note_strain();
  }
  if (collide_) add_contacts();
  alignas(64) Real largest2[most_lanes] = {};
  const std::uint32_t too_fast = voxels_(state_.data, largest2);
  state_.data.rate_scale = static_cast<Real>(1.0 / first.time_step_s);
  ++steps_;
  const std::size_t before = in_lanes_;
  for (std::size_t lane = 0; lane < robots_.size(); ++lane) {
    if (robots_[lane].in_lane) end_step(lane, bit(too_fast, lane), std::sqrt(static_cast<double>(largest2[lane])));
  }
  if (in_lanes_ != before && in_lanes_ > 0) fill_lanes();
}

/// What the engine does at the end of its own step.
template <class Real>
void LaneGroup<Real>::end_step(std::size_t lane, bool out_of_range, double largest_displacement_m) {
  Robot& robot = robots_[lane];
  EngineOf<Real>& engine = *robot.engine;
  if (engine.close_pairs_) engine.close_pairs_->moved(largest_displacement_m);
  if (out_of_range || engine.divergence) {
    take_out(lane);
    robot.in_lane = false;
    --in_lanes_;
    if (out_of_range) {
      engine.note_speed();
    } else {
      engine.stay_near_origin(largest_displacement_m);
    }
    engine.divergence->time_s = static_cast<double>(steps_) * engine.time_step_s;
    return;
  }
  const bool looks = engine.looks_at_origin_after(largest_displacement_m);
  if (looks) state_.take_poses(static_cast<int>(lane), engine.state_->data, robot.places);
  engine.stay_near_origin(largest_displacement_m);
  if (!looks) return;
  state_.put_positions(static_cast<int>(lane), engine.state_->data, robot.places);
  pairs_changed_ = collide_;
}

template <class Real>
void LaneGroup<Real>::take_out(std::size_t lane) {
  const Robot& robot = robots_[lane];
  state_.take(static_cast<int>(lane), robot.engine->state_->data, robot.places);
  robot.engine->state_->data.rate_scale = state_.data.rate_scale;
  robot.engine->steps = steps_;
}

/// Lanes without a robot of their own go on as copies of the first that has one.
template <class Real>
void LaneGroup<Real>::fill_lanes() {
  int twin = 0;
  while (!robots_[static_cast<std::size_t>(twin)].in_lane) ++twin;
  for (int lane = 0; lane < lanes_; ++lane) {
    int& robot = pairs_of_[static_cast<std::size_t>(lane)];
    if (robots_[static_cast<std::size_t>(robot)].in_lane) continue;
    state_.copy_lane(twin, lane);
    robot = twin;
  }
  pairs_changed_ = collide_;
}

template <class Real>
void LaneGroup<Real>::advance(std::uint64_t count, const std::atomic<bool>* stop) {
  for (std::uint64_t i = 0; i < count && in_lanes_ > 0; ++i) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) break;
    step();
  }
  for (std::size_t lane = 0; lane < robots_.size(); ++lane) {
    if (robots_[lane].in_lane) take_out(lane);
  }
}

template class LaneGroup<double>;
template class LaneGroup<float>;

}  // namespace menger::voxel
