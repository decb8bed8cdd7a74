#include "voxel/lanes/lane_group.h"

#include <array>
#include <utility>

namespace menger::voxel {

template <class Real>
Lattice LaneGroup<Real>::shared_lattice(const std::vector<MovingBody<Real>*>& robots) {
  const std::array<int, 3>& grid = robots.front()->body().lattice.grid;
  meshes::Polycube all(grid[0], grid[1], grid[2]);
  for (const MovingBody<Real>* robot : robots) {
    for (const meshes::CellIndex& cell : robot->body().lattice.cells) all.set(cell, 1);
  }
  return Lattice(all);
}

template <class Real>
LaneGroup<Real>::LaneGroup(const std::vector<MovingBody<Real>*>& robots, const LaneKernels<Real>& kernels)
    : lattice_(shared_lattice(robots)),
      state_(lattice_, robots.front()->body().edge_m, kernels.lanes),
      lanes_(kernels.lanes),
      in_lanes_(robots.size()) {
  for (MovingBody<Real>* robot : robots) {
    const int lane = static_cast<int>(robots_.size());
    robots_.push_back({robot, LanePlaces(lattice_, robot->body().lattice)});
    state_.put(lane, robot->data(), robots_.back().places);
    collide_ = collide_ || robot->close_pairs() != nullptr;
    pairs_of_.push_back(lane);
  }
  for (int lane = static_cast<int>(robots_.size()); lane < lanes_; ++lane) {
    const int twin = lane % static_cast<int>(robots_.size());
    state_.copy_lane(twin, lane);
    pairs_of_.push_back(twin);
  }
  choose_kernels(kernels);
  pairs_changed_ = collide_;
}

template <class Real>
void LaneGroup<Real>::choose_kernels(const LaneKernels<Real>& kernels) {
  const MovingBody<Real>& first = *robots_.front().moving;
  const Physics& physics = first.body().physics;
  const bool same_materials = physics.materials[0] == physics.materials[1];
  bool uniform = true;
  bool complete = true;
  for (const Robot& robot : robots_) {
    const bool like_first =
        same_materials || robot.moving->body().lattice.material.front() == first.body().lattice.material.front();
    uniform = uniform && like_first && robot.moving->state().uniform();
    complete = complete && robot.places.voxel.size() == lattice_.voxel_count();
  }
  state_.data.voxel = first.data().voxel;
  state_.data.beam = first.data().beam;
  beams_ = kernels.beams[physics.integration.damping == DampingMode::velocity][uniform][complete];
  voxels_ = kernels.voxels[uniform][complete];
  pairs_ = kernels.pairs[uniform];
}

template <class Real>
void LaneGroup<Real>::Lane::take() const {
  const Robot& robot = group.robots_[number];
  group.state_.take(static_cast<int>(number), robot.moving->data(), robot.places);
}

template <class Real>
void LaneGroup<Real>::Lane::take_poses() const {
  const Robot& robot = group.robots_[number];
  group.state_.take_poses(static_cast<int>(number), robot.moving->data(), robot.places);
}

template <class Real>
void LaneGroup<Real>::Lane::put_positions() const {
  const Robot& robot = group.robots_[number];
  group.state_.put_positions(static_cast<int>(number), robot.moving->data(), robot.places);
  group.pairs_changed_ = group.collide_;
}

template <class Real>
void LaneGroup<Real>::renew_pairs() {
  std::vector<typename LaneState<Real>::Pairs> of_robots(robots_.size());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Robot& robot = robots_[i];
    if (!robot.in_lane || robot.moving->close_pairs() == nullptr) continue;
    const auto place = [&](std::int32_t voxel) {
      return static_cast<std::int32_t>(robot.places.voxel[static_cast<std::size_t>(voxel)]);
    };
    for (const auto& [first, second] : robot.moving->close_pairs()->list().pairs())
      of_robots[i].emplace_back(place(first), place(second));
  }
  std::vector<typename LaneState<Real>::Pairs> of_lanes;
  for (const int robot : pairs_of_) of_lanes.push_back(of_robots[static_cast<std::size_t>(robot)]);
  state_.set_pairs(of_lanes);
  pairs_changed_ = false;
}

/// Finds the contact forces of all lanes. When one robot's list of close pairs is used up, all robots' lists are made anew.
/// Otherwise they would follow one by one, and the lanes' common list would be made anew each time.
template <class Real>
void LaneGroup<Real>::add_contacts() {
  const auto with_pairs = [&](const auto& act) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (robots_[i].in_lane && robots_[i].moving->close_pairs() != nullptr) act(i, *robots_[i].moving->close_pairs());
    }
  };
  std::array<bool, most_lanes> renewed{};
  bool anew = false;
  with_pairs([&](std::size_t lane, ClosePairs<Real>& pairs) {
    if (!pairs.looks_at_positions()) return;
    Lane{*this, lane}.take_poses();
    renewed[lane] = pairs.renew(robots_[lane].moving->data().pose);
    anew = anew || renewed[lane];
  });
  if (anew) {
    with_pairs([&](std::size_t lane, ClosePairs<Real>& pairs) {
      if (renewed[lane]) return;
      Lane{*this, lane}.take_poses();
      pairs.make(robots_[lane].moving->data().pose);
    });
  }
  if (anew || pairs_changed_) renew_pairs();
  bool may_touch = false;
  with_pairs([&](std::size_t, ClosePairs<Real>& pairs) {
    if (pairs.may_touch()) may_touch = true;
  });
  if (may_touch) pairs_(state_.data);
}

template <class Real>
void LaneGroup<Real>::step() {
  const auto bit = [](std::uint32_t bits, std::size_t lane) { return ((bits >> lane) & 1U) != 0; };
  MovingBody<Real>& leader = *robots_[leader_].moving;
  leader.begin_step();
  const StepConstants<Real>& constants = leader.data();
  static_cast<StepConstants<Real>&>(state_.data) = constants;
  const std::uint32_t strained = beams_(state_.data);
  for (std::size_t lane = 0; strained != 0 && lane < robots_.size(); ++lane) {
    if (!bit(strained, lane) || !robots_[lane].in_lane) continue;
    Lane{*this, lane}.take();
    robots_[lane].moving->check_strains(true);
  }
  if (collide_) add_contacts();
  alignas(64) Real largest2[most_lanes] = {};
  const std::uint32_t too_fast = voxels_(state_.data, largest2);
  const std::size_t before = in_lanes_;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Robot& robot = robots_[i];
    if (!robot.in_lane) continue;
    const Lane lane{*this, i};
    robot.moving->end_step({bit(too_fast, i), static_cast<double>(largest2[i])}, lane);
    if (!robot.moving->record().divergence) continue;
    lane.take();
    robot.in_lane = false;
    --in_lanes_;
  }
  if (in_lanes_ != before && in_lanes_ > 0) fill_lanes();
}

/// Fills the lanes of diverged robots with copies of the first robot that has not diverged.
template <class Real>
void LaneGroup<Real>::fill_lanes() {
  while (!robots_[leader_].in_lane) ++leader_;
  for (int lane = 0; lane < lanes_; ++lane) {
    int& robot = pairs_of_[static_cast<std::size_t>(lane)];
    if (robots_[static_cast<std::size_t>(robot)].in_lane) continue;
    robot = static_cast<int>(leader_);
    state_.copy_lane(robot, lane);
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
    if (robots_[lane].in_lane) Lane{*this, lane}.take();
  }
}

template class LaneGroup<double>;
template class LaneGroup<float>;

}  // namespace menger::voxel
