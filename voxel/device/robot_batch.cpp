#include "voxel/device/robot_batch.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include "io/device/block_thread.h"
#include "voxel/device/robot_step.h"

namespace menger::voxel {

namespace {

/// Skin of the lists of possible contacts, in voxel edges. Wider lists hold more pairs, narrower ones are made anew more often.
constexpr double partner_skin_edges = 0.2;

/// Rounding errors of distances and paths, as a share.
constexpr double rounding_share = 1e-5;

/// Voxels are padded to a multiple of the threads that run in step.
constexpr std::uint32_t threads_in_step = 32;

/// Threads of a block. With more, each has too few registers for the law of a beam.
constexpr std::uint32_t most_threads = 256;

/// Threads of a block whose robot does not fit its memory.
constexpr std::uint32_t most_threads_of_large = 512;

/// Memory of a block, bytes: what compute capability 9.0 has, less what a block needs beside its robot.
constexpr std::size_t most_block_bytes = std::size_t{224} * 1024;

std::uint32_t rounded_up(std::size_t count, std::uint32_t multiple) {
  return static_cast<std::uint32_t>((count + multiple - 1) / multiple * multiple);
}

/// Appends as many zeros as are asked for, and returns where they begin.
template <class Number>
std::size_t reserve(std::vector<Number>& numbers, std::size_t count) {
  const std::size_t begin = numbers.size();
  numbers.resize(begin + count);
  return begin;
}

template <class Number, class Range>
std::size_t append(std::vector<Number>& numbers, const Range& more) {
  const std::size_t begin = numbers.size();
  numbers.insert(numbers.end(), more.begin(), more.end());
  return begin;
}

/// Calls a function with the kind of a robot's steps as constants: whether its damping is from velocities, and whether it has one
/// set of coefficients.
template <class Real, class Function>
void with_kind(bool velocity, bool uniform, const Function& function) {
  const auto with_velocity = [&](auto is_uniform) {
    if (velocity) {
      function(std::true_type{}, is_uniform);
    } else if constexpr (std::is_same_v<Real, double>) {  // single precision needs damping from velocities
      function(std::false_type{}, is_uniform);
    }
  };
  if (uniform) {
    with_velocity(std::true_type{});
  } else {
    with_velocity(std::false_type{});
  }
}

/// Returns the fewest threads with which the beams of an axis take no more rounds than with the most threads.
std::uint32_t threads_for(std::size_t most_beams, std::uint32_t most) {
  const std::size_t rounds = std::max<std::size_t>(1, (most_beams + most - 1) / most);
  return std::max(threads_in_step, rounded_up((most_beams + rounds - 1) / rounds, threads_in_step));
}

}  // namespace

template <class Real>
RobotBatch<Real>::RobotBatch(std::vector<MovingBody<Real>*> robots) : robots_(std::move(robots)) {
  for (const MovingBody<Real>* robot : robots_) add(*robot);
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    put(i);
    choose_launch(i);
  }
  outcomes.resize(robots_.size());
  progress_.resize(robots_.size());
}

template <class Real>
void RobotBatch<Real>::add(const MovingBody<Real>& robot) {
  const StepData<Real>& d = robot.data();
  RobotData<Real> one;
  static_cast<StepConstants<Real>&>(one) = static_cast<const StepConstants<Real>&>(d);
  one.rate_scale = static_cast<Real>(1.0 / robot.body().time_step_s);
  one.floor_depth = d.floor_depth;
  one.displacement_limit2 = d.displacement_limit2;
  one.voxel = d.voxel;
  one.beam = d.beam;
  one.size_drive = robot.shaped() ? SizeDrive::shaped : SizeDrive::sine;
  add_voxels(robot, one);
  add_beams(robot, one);
  add_contacts(robot, one);
  data.push_back(one);
}

template <class Real>
void RobotBatch<Real>::add_voxels(const MovingBody<Real>& robot, RobotData<Real>& one) {
  const StepData<Real>& d = robot.data();
  one.voxels = static_cast<std::uint32_t>(d.voxels);
  one.stride = rounded_up(d.voxels, threads_in_step);
  const std::size_t stride = one.stride;
  one.pose = reserve(state, line_size * stride);
  one.motion = reserve(state, line_size * stride);
  if constexpr (std::is_same_v<Real, float>) one.residual = reserve(state, 3 * stride);
  one.size_parts = reserve(constants, 3 * stride);
  one.voxel_class = reserve(indices, stride);
  for (std::size_t i = 0; i < d.voxels; ++i) {
    constants[one.size_parts + i] = d.size_base[i];
    constants[one.size_parts + stride + i] = d.size_sine_part[i];
    constants[one.size_parts + 2 * stride + i] = d.size_cosine_part[i];
    indices[one.voxel_class + i] = d.voxel_class[i];
  }
  const std::size_t classes = robot.body().classes.voxel.size();
  one.voxel_table = append(constants, std::vector<Real>(d.voxel_table, d.voxel_table + class_values * classes));
  one.loads = loads_size;
  loads_size += numbers_of_load * stride;
  one.has_external = d.external_load != nullptr;
  if (!one.has_external) return;
  one.external = reserve(constants, numbers_of_load * stride);
  for (std::size_t i = 0; i < d.voxels; ++i) {
    const Real* load = d.external_load + line_size * i;
    for (std::size_t k = 0; k < 3; ++k) {
      constants[one.external + stride * k + i] = load[slot::fx + k];
      constants[one.external + stride * (k + 3) + i] = load[slot::mx + k];
    }
  }
}

template <class Real>
void RobotBatch<Real>::add_beams(const MovingBody<Real>& robot, RobotData<Real>& one) {
  const StepData<Real>& d = robot.data();
  std::array<std::size_t, 3> counts{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    counts[axis] = robot.body().lattice.beams[axis].lower.size();
    one.beam_begin[axis + 1] = one.beam_begin[axis] + static_cast<std::uint32_t>(counts[axis]);
  }
  one.history = reserve(state, history_size * one.beams());
  const auto joined = [&](const std::int32_t* BeamAxisData<Real>::*values) {
    const std::size_t begin = indices.size();
    for (std::size_t axis = 0; axis < 3; ++axis)
      indices.insert(indices.end(), d.axis[axis].*values, d.axis[axis].*values + counts[axis]);
    return begin;
  };
  one.lower = joined(&BeamAxisData<Real>::lower);
  one.upper = joined(&BeamAxisData<Real>::upper);
  one.beam_class = joined(&BeamAxisData<Real>::beam_class);
  const std::size_t classes = robot.body().classes.beam.size();
  one.beam_table = append(constants, std::vector<Real>(d.beam_table, d.beam_table + class_values * classes));
}

template <class Real>
void RobotBatch<Real>::add_contacts(const MovingBody<Real>& robot, RobotData<Real>& one) {
  if (robot.close_pairs() == nullptr) return;
  const VoxelBody& body = robot.body();
  CollisionRule rule(body.lattice, *body.physics.collisions.exclusion_depth);
  one.surface_voxels = static_cast<std::uint32_t>(rule.surface().size());
  one.surface = append(indices, rule.surface());
  std::vector<std::int32_t> excluded;
  one.exclusion_begin = reserve(indices, rule.surface().size() + 1);
  for (std::size_t s = 0; s < rule.surface().size(); ++s) {
    append(excluded, rule.excluded(rule.surface()[s]));
    indices[one.exclusion_begin + s + 1] = static_cast<std::int32_t>(excluded.size());
  }
  one.exclusions = append(indices, excluded);
  const double skin_m = partner_skin_edges * body.edge_m;
  const double reach_m = 2.0 * collision_radius_fraction * robot.close_pairs()->largest_size_m() + skin_m;
  one.list_reach2 = static_cast<Real>((1.0 + rounding_share) * reach_m * reach_m);
  one.half_skin = static_cast<Real>((1.0 - rounding_share) * 0.5 * skin_m);
  one.partners = partners_size;
  partners_size += std::size_t{1 + most_partners} * one.surface_voxels;
}

template <class Real>
void RobotBatch<Real>::choose_launch(std::uint32_t position) {
  const RobotData<Real>& one = data[position];
  LaunchShape shape;
  shape.velocity = robots_[position]->body().physics.integration.damping == DampingMode::velocity;
  shape.uniform = robots_[position]->state().uniform();
  shape.block_bytes = (2 * line_size + numbers_of_load) * one.stride * sizeof(Real);
  shape.in_block = shape.block_bytes <= most_block_bytes;
  if (!shape.in_block) shape.block_bytes = 0;
  std::size_t most_beams = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    most_beams = std::max<std::size_t>(most_beams, one.beam_begin[axis + 1] - one.beam_begin[axis]);
  shape.threads = threads_for(most_beams, shape.in_block ? most_threads : most_threads_of_large);
  const auto alike = std::ranges::find_if(launches_, [&](const Launch& launch) {
    LaunchShape same_memory = launch.shape;
    same_memory.block_bytes = shape.block_bytes;
    return same_memory == shape;
  });
  if (alike == launches_.end()) {
    launches_.push_back({shape, {position}});
  } else {
    alike->shape.block_bytes = std::max(alike->shape.block_bytes, shape.block_bytes);
    alike->robots.push_back(position);
  }
}

template <class Real>
void RobotBatch<Real>::put(std::size_t robot) {
  RobotData<Real>& one = data[robot];
  const StepData<Real>& d = robots_[robot]->data();
  one.floor_depth = d.floor_depth;
  for (std::size_t i = 0; i < one.voxels; ++i) {
    for (std::size_t k = 0; k < line_size; ++k) {
      state[one.pose + one.stride * k + i] = d.pose[line_size * i + k];
      state[one.motion + one.stride * k + i] = d.motion[line_size * i + k];
    }
    for (std::size_t k = 0; k < 3 && std::is_same_v<Real, float>; ++k)
      state[one.residual + one.stride * k + i] = d.position_residual[line_size * i + k];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = d.axis[axis];
    const std::size_t count = one.beam_begin[axis + 1] - one.beam_begin[axis];
    for (std::size_t k = 0; k < history_size; ++k)
      std::copy_n(beams.history + beams.count * k, count, state.data() + one.history + one.beams() * k + one.beam_begin[axis]);
  }
}

template <class Real>
void RobotBatch<Real>::take(std::size_t robot) {
  const RobotData<Real>& one = data[robot];
  Progress& progress = progress_[robot];
  if (progress.made == 0) return;
  const StepData<Real>& d = robots_[robot]->data();
  for (std::size_t i = 0; i < one.voxels; ++i) {
    for (std::size_t k = 0; k < line_size; ++k) {
      d.pose[line_size * i + k] = state[one.pose + one.stride * k + i];
      d.motion[line_size * i + k] = state[one.motion + one.stride * k + i];
    }
    for (std::size_t k = 0; k < 3 && std::is_same_v<Real, float>; ++k)
      d.position_residual[line_size * i + k] = state[one.residual + one.stride * k + i];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = d.axis[axis];
    const std::size_t count = one.beam_begin[axis + 1] - one.beam_begin[axis];
    for (std::size_t k = 0; k < history_size; ++k)
      std::copy_n(state.data() + one.history + one.beams() * k + one.beam_begin[axis], count, beams.history + beams.count * k);
  }
  robots_[robot]->take_over(progress.made, progress.end == RobotEnd::strained, progress.end == RobotEnd::too_fast);
  progress.made = 0;
}

template <class Real>
void RobotBatch<Real>::plan(const std::vector<std::uint32_t>& most) {
  steps.assign(robots_.size(), 0);
  drives.clear();
  std::vector<std::size_t> planned;  // robots, each with drives of its own
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (!goes_on(i)) continue;
    steps[i] = most[i];
    data[i].is_first_step = all_steps(i) == 0;
    const VoxelBody& body = robots_[i]->body();
    const auto alike = std::ranges::find_if(planned, [&](std::size_t other) {
      const VoxelBody& its = robots_[other]->body();
      return steps[other] >= steps[i] && all_steps(other) == all_steps(i) && its.time_step_s == body.time_step_s &&
             its.physics.actuation == body.physics.actuation && robots_[other]->shaped() == robots_[i]->shaped();
    });
    if (alike != planned.end()) {
      data[i].drives = data[*alike].drives;
      continue;
    }
    data[i].drives = drives.size();
    for (std::uint64_t n = 1; n <= steps[i]; ++n) {
      const DriveMoment moment = robots_[i]->drive_after(all_steps(i) + n);
      drives.push_back({moment.sine, moment.cosine, moment.sine_rate, moment.cosine_rate});
    }
    planned.push_back(i);
  }
}

template <class Real>
void RobotBatch<Real>::note_outcomes() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (steps[i] == 0) continue;
    progress_[i].made += outcomes[i].steps;
    progress_[i].end = outcomes[i].end;
  }
}

template <class Real>
void RobotBatch<Real>::step_alone() {
  std::vector<std::int32_t> partners(partners_size);
  std::vector<Real> loads(loads_size);
  BatchArrays<Real> arrays{.robots = data.data(),
                           .steps = steps.data(),
                           .outcomes = outcomes.data(),
                           .state = state.data(),
                           .constants = constants.data(),
                           .indices = indices.data(),
                           .drives = drives.data(),
                           .partners = partners.data(),
                           .loads = loads.data()};
  for (const Launch& launch : launches_) {
    for (const std::uint32_t robot : launch.robots) {
      const RobotData<Real>& one = data[robot];
      const SharedLines<Real> lines{arrays.state + one.pose, arrays.state + one.motion, arrays.loads + one.loads};
      if (steps[robot] == 0) continue;
      const io::LoneThread thread;
      with_kind<Real>(launch.shape.velocity, launch.shape.uniform, [&](auto velocity, auto uniform) {
        outcomes[robot] = RobotStepper<velocity, uniform, Real, io::LoneThread>(thread, one, arrays, lines).advance(steps[robot]);
      });
    }
  }
}

template class RobotBatch<double>;
template class RobotBatch<float>;

}  // namespace menger::voxel
