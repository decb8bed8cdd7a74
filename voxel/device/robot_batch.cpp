#include "voxel/device/robot_batch.h"

#include <algorithm>
#include <array>
#include <functional>
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

/// Beams along one axis with which one block steps a robot no later than many blocks step the largest robots, of 19,683 voxels.
constexpr std::size_t most_beams_of_one_block = 1024;

/// Voxels are padded to a multiple of the threads that run in step.
constexpr std::uint32_t threads_in_step = 32;

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

/// Calls a function with the kind of a robot's steps as constants: whether its damping is from velocities, and its BeamVariety.
template <class Real, class Function>
void with_kind(bool velocity, BeamVariety variety, const Function& function) {
  const auto with_velocity = [&](auto constant_variety) {
    if (velocity) {
      function(std::true_type{}, constant_variety);
    } else if constexpr (std::is_same_v<Real, double>) {  // single precision needs damping from velocities
      function(std::false_type{}, constant_variety);
    }
  };
  if (variety == BeamVariety::uniform) {
    with_velocity(std::integral_constant<BeamVariety, BeamVariety::uniform>{});
  } else if (variety == BeamVariety::classes) {
    with_velocity(std::integral_constant<BeamVariety, BeamVariety::classes>{});
  } else {
    with_velocity(std::integral_constant<BeamVariety, BeamVariety::own_lengths>{});
  }
}

/// Returns the fewest threads with which the beams of an axis take no more rounds than with the most threads.
std::uint32_t threads_for(std::size_t most_beams) {
  const std::size_t rounds = std::max<std::size_t>(1, (most_beams + most_block_threads - 1) / most_block_threads);
  return std::max(threads_in_step, rounded_up((most_beams + rounds - 1) / rounds, threads_in_step));
}

/// Returns the most beams along one axis.
template <class Real>
std::size_t most_beams_of(const RobotData<Real>& robot) {
  std::size_t most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    most = std::max<std::size_t>(most, robot.beam_begin[axis + 1] - robot.beam_begin[axis]);
  return most;
}

/// Memory of a block that has a robot's poses, motions and loads, bytes.
template <class Real>
std::size_t block_bytes_of(std::size_t voxels) {
  return (2 * line_size + numbers_of_load) * rounded_up(voxels, threads_in_step) * sizeof(Real);
}

}  // namespace

template <class Real>
RobotBatch<Real>::RobotBatch(std::vector<MovingBody<Real>*> robots, std::vector<FootContact<Real>*> contacts)
    : robots_(std::move(robots)), contacts_(std::move(contacts)) {
  all_fit_blocks_ = std::ranges::all_of(robots_, [](const MovingBody<Real>* robot) {
    return block_bytes_of<Real>(static_cast<std::size_t>(robot->data().voxels)) <= most_block_bytes;
  });
  for (std::size_t i = 0; i < robots_.size(); ++i) add(*robots_[i], contacts_[i]);
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    put(i);
    choose_launch(i);
  }
  // Large robots first: small ones find room beside them.
  std::ranges::stable_sort(launches_, std::greater{}, [](const Launch& launch) { return launch.shape.blocks; });
  outcomes.resize(robots_.size());
  progress_.resize(robots_.size());
}

template <class Real>
void RobotBatch<Real>::add(const MovingBody<Real>& robot, const FootContact<Real>* contact) {
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
  if (effective_coupling(robot.body().physics) != 0.0) add_coupling(robot, one);
  if (robot.pressures() != nullptr) add_calibrated(robot, contact, one);
  data.push_back(one);
}

template <class Real>
void RobotBatch<Real>::add_coupling(const MovingBody<Real>& robot, RobotData<Real>& one) {
  const VoxelBody& body = robot.body();
  one.has_coupling = true;
  one.half_coupling = static_cast<Real>(0.5 * effective_coupling(body.physics));
  one.axial = constants.size();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::size_t beam : body.classes.beam_class[axis])
      constants.push_back(static_cast<Real>(body.classes.beam[beam].axial));
  }
  one.coupling_sums = loads_size;
  loads_size += std::size_t{3} * one.stride;
}

template <class Real>
void RobotBatch<Real>::add_calibrated(const MovingBody<Real>& robot, const FootContact<Real>* contact, RobotData<Real>& one) {
  const auto& tables = robot.pressures()->tables();
  const CalibratedBody& calibrated = *robot.body().physics.surrogate;
  const ValidityRange& validity = calibrated.parameters.validity;
  CalibratedData& c = one.calibrated;
  c.has_kinks = robot.data().axis[0].half_kink != nullptr;
  c.refuses = calibrated.outside_range != OutsideRange::warn;
  c.smallest_strain = validity.smallest_strain;
  c.largest_strain = validity.largest_strain;
  c.edge_m = tables.edge_m;
  c.wave = tables.wave;
  c.phases = static_cast<std::uint32_t>(tables.phases.size());
  c.phase_table = phases.size();
  for (const auto& phase : tables.phases) phases.insert(phases.end(), phase.begin(), phase.end());
  c.walls = append(walls, tables.walls);
  c.responses = responses_size;
  responses_size += law_class_count * tables.phases.size();
  c.ranges = ranges_size;
  ranges_size += std::size_t{2} * most_blocks * most_block_threads;
  const auto index_of = [](std::size_t number) { return static_cast<std::int32_t>(number); };
  c.beam_halves = indices.size();
  for (std::size_t half = 0; half < 2; ++half) {
    for (const auto& beams : tables.beam_responses)
      for (const auto& of_halves : beams) indices.push_back(index_of(of_halves[half]));
  }
  c.necks_and_elbows = necks_and_elbows.size();
  c.entry_begin = indices.size();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto entry = tables.necks_and_elbows[axis].begin();
    for (std::size_t beam = 0; beam < tables.beam_responses[axis].size(); ++beam) {
      indices.push_back(index_of(necks_and_elbows.size() - c.necks_and_elbows));
      for (; entry != tables.necks_and_elbows[axis].end() && entry->beam == beam; ++entry) necks_and_elbows.push_back(*entry);
    }
  }
  indices.push_back(index_of(necks_and_elbows.size() - c.necks_and_elbows));
  c.voxel_halves = reserve(indices, std::size_t{3} * one.stride);
  for (std::size_t i = 0; i < one.voxels; ++i) {
    for (std::size_t k = 0; k < 3; ++k) indices[c.voxel_halves + one.stride * k + i] = index_of(tables.voxel_responses[i][k]);
  }
  c.lengths_in_use = append(indices, tables.lengths_in_use);
  c.lengths_in_use_count = static_cast<std::uint32_t>(tables.lengths_in_use.size());
  c.bulges_in_use = append(indices, tables.bulges_in_use);
  c.bulges_in_use_count = static_cast<std::uint32_t>(tables.bulges_in_use.size());
  if (contact != nullptr) add_feet(robot, *contact, one);
}

template <class Real>
void RobotBatch<Real>::add_feet(const MovingBody<Real>& robot, const FootContact<Real>& contact, RobotData<Real>& one) {
  const auto& bulges = robot.pressures()->tables().bulge_responses;
  CalibratedData& c = one.calibrated;
  c.has_feet = true;
  c.ground_m = contact.height_m();
  c.grounds = append(grounds, robot.body().classes.voxel);
  c.touches = reserve(touches, one.voxels);
  c.feet = feet.size();
  c.foot_begin = indices.size();
  for (std::size_t i = 0; i < one.voxels; ++i) {
    indices.push_back(static_cast<std::int32_t>(feet.size() - c.feet));
    for (const auto& foot : contact.feet(i)) {
      DeviceFoot& added = feet.emplace_back();
      added.kind = foot.of_wall.kind;
      added.axis = static_cast<std::uint32_t>(foot.of_wall.axis);
      std::ranges::copy(foot.of_wall.signs, added.signs);
      added.share = foot.of_wall.share;
      for (const std::size_t voxel : foot.of_wall.bulging)
        added.bulging.response[added.bulging.count++] = static_cast<std::int32_t>(bulges[voxel][foot.of_wall.axis]);
    }
  }
  indices.push_back(static_cast<std::int32_t>(feet.size() - c.feet));
  grips.resize(feet.size());
}

template <class Real>
void RobotBatch<Real>::put_feet(std::size_t robot) {
  CalibratedData& c = data[robot].calibrated;
  const FootContact<Real>& contact = *contacts_[robot];
  std::ranges::copy(robots_[robot]->state().origin_m(), c.origin_m);
  std::size_t next = c.feet;
  for (std::size_t i = 0; i < data[robot].voxels; ++i) {
    touches[c.touches + i] = (contact.touches(i) ? touches_ground : 0U) | (contact.sticks(i) ? sticks_to_ground : 0U);
    for (const auto& foot : contact.feet(i)) grips[next++] = foot.grip;
  }
}

template <class Real>
void RobotBatch<Real>::take_feet(std::size_t robot) {
  const CalibratedData& c = data[robot].calibrated;
  std::size_t next = c.feet;
  for (std::size_t i = 0; i < data[robot].voxels; ++i) {
    const std::size_t count = contacts_[robot]->feet(i).size();
    const std::uint32_t seen = touches[c.touches + i];
    contacts_[robot]->take_over(i, {grips.data() + next, count}, (seen & touches_ground) != 0, (seen & sticks_to_ground) != 0);
    next += count;
  }
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
  if (!all_fit_blocks_) add_beams_of_voxels(one);
  const std::size_t classes = robot.body().classes.beam.size();
  one.beam_table = append(constants, std::vector<Real>(d.beam_table, d.beam_table + class_values * classes));
}

template <class Real>
void RobotBatch<Real>::add_beams_of_voxels(RobotData<Real>& one) {
  one.beam_loads = loads_size;
  loads_size += std::size_t{2} * numbers_of_load * one.beams();
  one.beams_of_voxel = indices.size();
  indices.resize(indices.size() + std::size_t{ends_of_voxel} * one.stride, -1);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    for (std::uint32_t beam = one.beam_begin[axis]; beam < one.beam_begin[axis + 1]; ++beam) {
      const auto beam_at = [&](std::uint32_t end, std::size_t ends_of_beams) -> std::int32_t& {
        return indices[one.beams_of_voxel + std::size_t{one.stride} * (2 * axis + end) +
                       static_cast<std::size_t>(indices[ends_of_beams + beam])];
      };
      beam_at(0, one.upper) = beam_at(1, one.lower) = static_cast<std::int32_t>(beam);
    }
  }
}

template <class Real>
void RobotBatch<Real>::add_contacts(const MovingBody<Real>& robot, RobotData<Real>& one) {
  if (robot.close_pairs() == nullptr) return;
  const VoxelBody& body = robot.body();
  CollisionRule rule(body.lattice, *body.physics.collisions.exclusion_depth);
  one.surface_voxels = static_cast<std::uint32_t>(rule.surface().size());
  one.surface = append(indices, rule.surface());
  one.surface_position = indices.size();
  indices.resize(indices.size() + one.voxels, -1);
  for (std::uint32_t s = 0; s < one.surface_voxels; ++s)
    indices[one.surface_position + static_cast<std::size_t>(indices[one.surface + s])] = static_cast<std::int32_t>(s);
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
  one.boxes = loads_size;
  loads_size += std::size_t{numbers_of_box} * one.chunks();
}

template <class Real>
void RobotBatch<Real>::choose_launch(std::uint32_t position) {
  const RobotData<Real>& one = data[position];
  LaunchShape shape;
  shape.velocity = robots_[position]->body().physics.integration.damping == DampingMode::velocity;
  shape.variety = robots_[position]->pressures() != nullptr                   ? BeamVariety::own_lengths
                  : robots_[position]->state().uniform() && !one.has_coupling ? BeamVariety::uniform
                                                                              : BeamVariety::classes;
  const std::size_t most_beams = most_beams_of(one);
  // Blocks that keep robots in their memory do not stand beside others, which want it as a cache.
  shape.in_block = all_fit_blocks_;
  if (shape.in_block) {
    shape.block_bytes = block_bytes_of<Real>(one.voxels);
    shape.threads = threads_for(most_beams);
  } else {
    // Few kinds of launches stand beside each other. A large robot is what the others wait for: it gets all that it can.
    shape.blocks = most_beams > most_beams_of_one_block ? most_blocks : 1;
    shape.threads = most_block_threads;
  }
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
  if (one.calibrated.has_feet) put_feet(robot);
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
  if (one.calibrated.has_feet) take_feet(robot);
  robots_[robot]->take_over(progress.made, progress.end == RobotEnd::strained, progress.end == RobotEnd::too_fast,
                            progress.strains);
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
             its.physics.actuation == body.physics.actuation && robots_[other]->shaped() == robots_[i]->shaped() &&
             its.hollow.has_value() == body.hollow.has_value();
    });
    if (alike != planned.end()) {
      data[i].drives = data[*alike].drives;
      continue;
    }
    data[i].drives = drives.size() + 1;
    for (std::uint64_t n = 0; n <= steps[i]; ++n) drives.push_back(robots_[i]->drive_after(all_steps(i) + n));
    planned.push_back(i);
  }
}

template <class Real>
void RobotBatch<Real>::note_outcomes() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (steps[i] == 0) continue;
    progress_[i].made += outcomes[i].steps;
    progress_[i].end = outcomes[i].end;
    progress_[i].strains.smallest = std::min(progress_[i].strains.smallest, outcomes[i].strains.smallest);
    progress_[i].strains.largest = std::max(progress_[i].strains.largest, outcomes[i].strains.largest);
  }
}

template <class Real>
void RobotBatch<Real>::step_alone() {
  std::vector<std::int32_t> partners(partners_size);
  std::vector<Real> loads(loads_size);
  std::vector<WallResponse> responses(responses_size);
  std::vector<double> ranges(ranges_size);
  BatchArrays<Real> arrays{.robots = data.data(),
                           .steps = steps.data(),
                           .outcomes = outcomes.data(),
                           .state = state.data(),
                           .constants = constants.data(),
                           .indices = indices.data(),
                           .drives = drives.data(),
                           .partners = partners.data(),
                           .loads = loads.data(),
                           .phases = phases.data(),
                           .walls = walls.data(),
                           .necks_and_elbows = necks_and_elbows.data(),
                           .feet = feet.data(),
                           .grounds = grounds.data(),
                           .responses = responses.data(),
                           .ranges = ranges.data(),
                           .grips = grips.data(),
                           .touches = touches.data()};
  for (const Launch& launch : launches_) {
    for (const std::uint32_t robot : launch.robots) {
      const RobotData<Real>& one = data[robot];
      const SharedLines<Real> lines{arrays.state + one.pose, arrays.state + one.motion, arrays.loads + one.loads};
      if (steps[robot] == 0) continue;
      const io::LoneThread thread;
      with_kind<Real>(launch.shape.velocity, launch.shape.variety, [&](auto velocity, auto variety) {
        const auto advance = [&](auto gathers) {
          return RobotStepper<velocity, variety, gathers, Real, io::LoneThread>(thread, one, arrays, lines).advance(steps[robot]);
        };
        outcomes[robot] = launch.shape.in_block ? advance(std::false_type{}) : advance(std::true_type{});
      });
    }
  }
}

template class RobotBatch<double>;
template class RobotBatch<float>;

}  // namespace menger::voxel
