#include "voxel/lanes/lane_state.h"

#include <algorithm>
#include <cassert>

namespace menger::voxel {

namespace {

constexpr auto voxel_size = static_cast<std::size_t>(voxel_values);
constexpr auto beam_size = static_cast<std::size_t>(beam_values);

}  // namespace

LanePlaces::LanePlaces(const Lattice& shared, const Lattice& robot) {
  // Both lattices are in grid order, so one pass finds every cell.
  std::size_t place = 0;
  for (const meshes::CellIndex& cell : robot.cells) {
    while (place < shared.cells.size() && shared.cells[place] != cell) ++place;
    assert(place < shared.cells.size());
    voxel.push_back(place);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& all = shared.beams[axis];
    std::size_t beam_place = 0;
    for (const std::int32_t lower : robot.beams[axis].lower) {
      const auto lower_place = static_cast<std::int32_t>(voxel[static_cast<std::size_t>(lower)]);
      while (all.lower[beam_place] != lower_place) ++beam_place;
      beam[axis].push_back(beam_place);
    }
  }
}

template <class Real>
LaneState<Real>::LaneState(const Lattice& shared, double cell_edge_m, int lanes) : lanes_(lanes) {
  assert(lanes >= 1 && lanes <= most_lanes);
  const auto width = static_cast<std::size_t>(lanes);
  const std::size_t voxels = shared.voxel_count();
  data.voxels = voxels;
  pose_.assign(line_size * voxels * width, Real(0));
  motion_.assign(line_size * voxels * width, Real(0));
  load_.assign(line_size * voxels * width, Real(0));
  residual_.assign(3 * voxels * width, Real(0));
  drive_.assign(drive_size * voxels * width, Real(0));
  present_.assign(voxels * width, Real(0));
  voxel_coefficients_.assign(voxel_size * voxels * width, Real(0));
  const auto edge = static_cast<Real>(cell_edge_m);
  for (std::size_t i = 0; i < voxels; ++i) {
    for (int lane = 0; lane < lanes; ++lane) {
      pose_[at(line_size * i + slot::size, lane)] = edge;
      pose_[at(line_size * i + slot::qw, lane)] = Real(1);
      drive_[at(drive_size * i, lane)] = edge;
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t beams = shared.beams[axis].lower.size();
    beam_present_[axis].assign(beams * width, Real(0));
    beam_coefficients_[axis].assign(beam_size * beams * width, Real(0));
    history_[axis].assign(history_size * beams * width, Real(0));
    for (std::size_t i = 0; i < beams; ++i) {
      for (int lane = 0; lane < lanes; ++lane) history_[axis][at(history_size * i + history_size - 1, lane)] = Real(1);
    }
  }
  point_to_arrays(shared);
}

template <class Real>
void LaneState<Real>::point_to_arrays(const Lattice& shared) {
  data.pose = pose_.data();
  data.motion = motion_.data();
  data.load = load_.data();
  data.position_residual = residual_.data();
  data.drive = drive_.data();
  data.present = present_.data();
  data.voxel_coefficients = voxel_coefficients_.data();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    data.axis[axis] = {.count = shared.beams[axis].lower.size(),
                       .lower = shared.beams[axis].lower.data(),
                       .upper = shared.beams[axis].upper.data(),
                       .present = beam_present_[axis].data(),
                       .coefficients = beam_coefficients_[axis].data(),
                       .history = history_[axis].data()};
  }
}

template <class Real>
void LaneState<Real>::put(int lane, const StepData<Real>& robot, const LanePlaces& places) {
  assert(robot.external_load == nullptr);
  for (std::size_t i = 0; i < places.voxel.size(); ++i) {
    const std::size_t place = places.voxel[i];
    for (std::size_t k = 0; k < line_size; ++k) {
      pose_[at(line_size * place + k, lane)] = robot.pose[line_size * i + k];
      motion_[at(line_size * place + k, lane)] = robot.motion[line_size * i + k];
    }
    const Real* row = robot.voxel_table + line_size * static_cast<std::size_t>(robot.voxel_class[i]);
    for (std::size_t k = 0; k < voxel_size; ++k) voxel_coefficients_[at(voxel_size * place + k, lane)] = row[k];
    drive_[at(drive_size * place, lane)] = robot.size_base[i];
    drive_[at(drive_size * place + 1, lane)] = robot.size_sine_part[i];
    drive_[at(drive_size * place + 2, lane)] = robot.size_cosine_part[i];
    present_[at(place, lane)] = Real(1);
  }
  put_positions(lane, robot, places);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = robot.axis[axis];
    for (std::size_t i = 0; i < places.beam[axis].size(); ++i) {
      const std::size_t place = places.beam[axis][i];
      const Real* row = robot.beam_table + line_size * static_cast<std::size_t>(beams.beam_class[i]);
      for (std::size_t k = 0; k < beam_size; ++k) beam_coefficients_[axis][at(beam_size * place + k, lane)] = row[k];
      for (std::size_t k = 0; k < history_size; ++k)
        history_[axis][at(history_size * place + k, lane)] = beams.history[k * beams.count + i];
      beam_present_[axis][at(place, lane)] = Real(1);
    }
  }
  data.displacement_limit2[lane] = robot.displacement_limit2;
}

template <class Real>
void LaneState<Real>::put_positions(int lane, const StepData<Real>& robot, const LanePlaces& places) {
  for (std::size_t i = 0; i < places.voxel.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      pose_[at(line_size * places.voxel[i] + k, lane)] = robot.pose[line_size * i + k];
      residual_[at(3 * places.voxel[i] + k, lane)] = robot.position_residual[line_size * i + k];
    }
  }
  data.floor_depth[lane] = robot.floor_depth;
}

template <class Real>
void LaneState<Real>::take_poses(int lane, StepData<Real>& robot, const LanePlaces& places) const {
  for (std::size_t i = 0; i < places.voxel.size(); ++i) {
    for (std::size_t k = 0; k < line_size; ++k) robot.pose[line_size * i + k] = pose_[at(line_size * places.voxel[i] + k, lane)];
    for (std::size_t k = 0; k < 3; ++k) robot.position_residual[line_size * i + k] = residual_[at(3 * places.voxel[i] + k, lane)];
  }
}

template <class Real>
void LaneState<Real>::take(int lane, StepData<Real>& robot, const LanePlaces& places) const {
  take_poses(lane, robot, places);
  for (std::size_t i = 0; i < places.voxel.size(); ++i) {
    for (std::size_t k = 0; k < line_size; ++k)
      robot.motion[line_size * i + k] = motion_[at(line_size * places.voxel[i] + k, lane)];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = robot.axis[axis];
    for (std::size_t i = 0; i < places.beam[axis].size(); ++i) {
      for (std::size_t k = 0; k < history_size; ++k)
        beams.history[k * beams.count + i] = history_[axis][at(history_size * places.beam[axis][i] + k, lane)];
    }
  }
}

template <class Real>
void LaneState<Real>::copy_lane(int from, int to) {
  const auto copy = [&](AlignedArray<Real>& values) {
    for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(lanes_))
      values[i + static_cast<std::size_t>(to)] = values[i + static_cast<std::size_t>(from)];
  };
  for (AlignedArray<Real>* values : {&pose_, &motion_, &load_, &residual_, &drive_, &present_, &voxel_coefficients_})
    copy(*values);
  for (auto* axes : {&beam_present_, &beam_coefficients_, &history_}) {
    for (AlignedArray<Real>& values : *axes) copy(values);
  }
  data.floor_depth[to] = data.floor_depth[from];
  data.displacement_limit2[to] = data.displacement_limit2[from];
}

template <class Real>
void LaneState<Real>::set_pairs(std::span<const Pairs> of_lanes) {
  Pairs all;
  for (const Pairs& pairs : of_lanes) all.insert(all.end(), pairs.begin(), pairs.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  pair_first_.clear();
  pair_second_.clear();
  for (const auto& [first, second] : all) {
    pair_first_.push_back(first);
    pair_second_.push_back(second);
  }
  pair_present_.assign(all.size() * static_cast<std::size_t>(lanes_), Real(0));
  for (std::size_t lane = 0; lane < of_lanes.size(); ++lane) {
    std::size_t place = 0;
    for (const auto& pair : of_lanes[lane]) {
      while (all[place] != pair) ++place;
      pair_present_[at(place, static_cast<int>(lane))] = Real(1);
    }
  }
  data.pairs = {.count = all.size(), .first = pair_first_.data(), .second = pair_second_.data(), .present = pair_present_.data()};
}

template class LaneState<double>;
template class LaneState<float>;

}  // namespace menger::voxel
