#include "voxel/engine/collisions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "voxel/laws/voxel_contact.h"

namespace menger::voxel {

namespace {

constexpr double kept_share = 0.8;  ///< share of the bound up to which a list is kept

/// Replaces the value of every cell of a grid by the largest value of the cell and its neighbours, including those across edges
/// and corners.
void take_from_around(std::vector<double>& values, const std::array<std::size_t, 3>& size) {
  std::size_t step = 1;
  for (const std::size_t count : size) {
    for (std::size_t first = 0; first < values.size(); first += step * count) {
      for (std::size_t i = first; i < first + step; ++i) {
        const std::size_t end = i + step * count;
        double before = values[i];
        for (std::size_t at = i; at < end; at += step) {
          const double here = values[at];
          const double after = at + step < end ? values[at + step] : here;
          values[at] = std::max(std::max(before, here), after);
          before = here;
        }
      }
    }
    step *= count;
  }
}

}  // namespace

CollisionRule::CollisionRule(const Lattice& lattice, int exclusion_depth)
    : neighbours_(&lattice.neighbours),
      exclusion_depth_(exclusion_depth),
      surface_(lattice.surface()),
      mark_(lattice.voxel_count(), 0) {
  // Nearly always the first voxel already has a partner beyond the depth, so that this loop ends at once.
  excludes_every_pair_ = std::all_of(surface_.begin(), surface_.end(), [this](std::int32_t voxel) {
    mark_within_depth(voxel);
    return std::all_of(surface_.begin(), surface_.end(),
                       [this](std::int32_t other) { return mark_[static_cast<std::size_t>(other)] == search_; });
  });
}

void CollisionRule::mark_within_depth(std::int32_t voxel) {
  ++search_;
  queue_.assign(1, voxel);
  mark_[static_cast<std::size_t>(voxel)] = search_;
  std::size_t level_begin = 0;
  for (int depth = 0; depth < exclusion_depth_ && level_begin < queue_.size(); ++depth) {
    const std::size_t level_end = queue_.size();
    for (; level_begin < level_end; ++level_begin) {
      for (const std::int32_t next : (*neighbours_)[static_cast<std::size_t>(queue_[level_begin])]) {
        if (next < 0 || mark_[static_cast<std::size_t>(next)] == search_) continue;
        mark_[static_cast<std::size_t>(next)] = search_;
        queue_.push_back(next);
      }
    }
  }
}

std::vector<std::int32_t> CollisionRule::excluded(std::int32_t voxel) {
  mark_within_depth(voxel);
  std::vector<std::int32_t> voxels = queue_;
  std::ranges::sort(voxels);
  return voxels;
}

void CollisionRule::keep_allowed(std::int32_t voxel, std::vector<std::int32_t>& candidates) {
  if (candidates.empty()) return;
  mark_within_depth(voxel);
  std::erase_if(candidates, [this](std::int32_t other) { return mark_[static_cast<std::size_t>(other)] == search_; });
}

VerletList::VerletList(CollisionRule rule, double reach_m, double skin_m)
    : rule_(std::move(rule)), reach_m_(reach_m), skin_m_(skin_m) {}

template <class Real>
void VerletList::build(const Real* positions, std::size_t stride) {
  built_at_.resize(3 * rule_.surface().size());
  for (std::size_t i = 0; i < rule_.surface().size(); ++i) {
    const Real* from = positions + stride * static_cast<std::size_t>(rule_.surface()[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) built_at_[3 * i + axis] = static_cast<double>(from[axis]);
  }
  find_pairs();
  put_in_order();
  bound_m_ = 0.0;
  built_ = true;
  ++number_;
}

/// Returns the value of bound_m_ at these positions. It is infinite where pairs that were far apart could be too close.
template <class Real>
double VerletList::true_bound_m(const Real* positions, std::size_t stride) {
  double largest2 = 0.0;
  for (std::size_t i = 0; i < rule_.surface().size(); ++i) {
    const Real* now = positions + stride * static_cast<std::size_t>(rule_.surface()[i]);
    double distance2 = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double moved = static_cast<double>(now[axis]) - built_at_[3 * i + axis];
      distance2 += moved * moved;
    }
    largest2 = std::max(largest2, distance2);
  }
  const double largest = std::sqrt(largest2);
  if (largest <= kept_share * (0.5 * skin_m_)) return largest;
  // Voxels whose cells were three apart had two cells between them. Until the next check they approach each other by at most a
  // skin.
  const Shift moved = shift(positions, stride);
  if (2.0 * cell_width_m_ - moved.far_m < reach_m_ + skin_m_) return std::numeric_limits<double>::infinity();
  return std::min(largest, 0.5 * moved.near_m);
}

/// Computes how far voxels moved relative to each other. Every cell gets the box of its voxels' displacements, widened to those
/// of the cells around it. Two voxels whose cells are one or two apart are thus both in the box of some cell.
template <class Real>
VerletList::Shift VerletList::shift(const Real* positions, std::size_t stride) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  for (std::vector<double>& of_cells : moves_) of_cells.assign(cells_[0] * cells_[1] * cells_[2], none);
  std::array<double, 6> all;
  all.fill(none);
  for (std::size_t i = 0; i < cell_of_.size(); ++i) {
    const Real* now = positions + stride * static_cast<std::size_t>(rule_.surface()[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double moved = static_cast<double>(now[axis]) - built_at_[3 * i + axis];
      for (const auto& [side, along] : {std::pair(axis, moved), std::pair(axis + 3, -moved)}) {
        double& of_cell = moves_[side][cell_of_[i]];
        of_cell = std::max(of_cell, along);
        all[side] = std::max(all[side], along);
      }
    }
  }
  for (std::vector<double>& of_cells : moves_) take_from_around(of_cells, cells_);
  const auto across2 = [](const auto& largest) {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = largest(axis) + largest(axis + 3);
      sum += along * along;
    }
    return sum;
  };
  double near2 = 0.0;
  for (std::size_t cell = 0; cell < moves_[0].size(); ++cell) {
    if (moves_[0][cell] == none) continue;  // no voxel in or around it
    near2 = std::max(near2, across2([&](std::size_t side) { return moves_[side][cell]; }));
  }
  return {std::sqrt(near2), std::sqrt(across2([&](std::size_t side) { return all[side]; }))};
}

template <class Real>
bool VerletList::refresh(const Real* positions, std::size_t stride) {
  if (!bound_used_up()) return false;
  if (built_) {
    // Below that share of the bound the list is good for many more steps. Above it a new list costs no more than checking again
    // soon.
    const double bound = true_bound_m(positions, stride);
    if (bound <= kept_share * (0.5 * skin_m_)) {
      bound_m_ = bound;
      return false;
    }
  }
  build(positions, stride);
  return true;
}

void VerletList::find_pairs() {
  pairs_.clear();
  distance_.clear();
  smallest_gap_m_ = skin_m_;
  const std::vector<std::int32_t>& surface = rule_.surface();
  const std::size_t count = surface.size();
  cell_width_m_ = reach_m_ + skin_m_;
  cells_ = {1, 1, 1};
  cell_of_.assign(count, 0);
  if (count < 2) return;

  std::array<double, 3> low{built_at_[0], built_at_[1], built_at_[2]};
  std::array<double, 3> high = low;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], built_at_[3 * i + axis]);
      high[axis] = std::max(high[axis], built_at_[3 * i + axis]);
    }
  }
  // Cells at least as wide as the cutoff; wider ones where fragments have flown far apart, so that the grid stays small.
  const double cutoff = reach_m_ + skin_m_;
  double width = cutoff;
  std::array<std::size_t, 3> size{};
  for (;; width *= 2.0) {
    double total = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      assert(std::isfinite(high[axis] - low[axis]));  // a run whose positions are not finite has diverged
      const double cells = std::floor((high[axis] - low[axis]) / width) + 1.0;
      total *= cells;
      size[axis] = total < 1e9 ? static_cast<std::size_t>(cells) : 0;
    }
    if (total <= 4.0 * static_cast<double>(count) + 4096.0) break;
  }
  const auto coordinate = [&](std::size_t i, std::size_t axis) {
    return std::min(static_cast<std::size_t>((built_at_[3 * i + axis] - low[axis]) / width), size[axis] - 1);
  };
  const auto cell = [&](std::size_t x, std::size_t y, std::size_t z) { return x + size[0] * (y + size[1] * z); };

  cell_width_m_ = width;
  cells_ = size;

  // Counting sort of the surface voxels into cells; within a cell they stay in ascending order.
  std::vector<std::size_t> start(size[0] * size[1] * size[2] + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    cell_of_[i] = cell(coordinate(i, 0), coordinate(i, 1), coordinate(i, 2));
    ++start[cell_of_[i] + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::size_t> members(count);
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < count; ++i) members[next[cell_of_[i]]++] = i;

  std::array<std::vector<double>, 3> sorted;  // positions in the order of the cells, so that neighbours are read one by one
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::size_t i : members) sorted[axis].push_back(built_at_[3 * i + axis]);
  }

  std::vector<std::int32_t> candidates;
  std::vector<std::pair<std::size_t, double>> near;  // with the square of the distance
  std::vector<double> distance2(count);
  std::vector<std::size_t> hits(count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    near.clear();
    const std::array<std::size_t, 3> at{coordinate(i, 0), coordinate(i, 1), coordinate(i, 2)};
    const std::array<double, 3> here{built_at_[3 * i], built_at_[3 * i + 1], built_at_[3 * i + 2]};
    for (std::size_t z = at[2] - (at[2] > 0); z <= std::min(at[2] + 1, size[2] - 1); ++z) {
      for (std::size_t y = at[1] - (at[1] > 0); y <= std::min(at[1] + 1, size[1] - 1); ++y) {
        const std::size_t first = start[cell(at[0] - (at[0] > 0), y, z)];
        const std::size_t last = start[cell(std::min(at[0] + 1, size[0] - 1), y, z) + 1];
        for (std::size_t k = first; k < last; ++k) {
          const double x_apart = here[0] - sorted[0][k];
          const double y_apart = here[1] - sorted[1][k];
          const double z_apart = here[2] - sorted[2][k];
          distance2[k] = x_apart * x_apart + y_apart * y_apart + z_apart * z_apart;
        }
        // Without a branch, because it could not be predicted.
        std::size_t found = 0;
        for (std::size_t k = first; k < last; ++k) {
          hits[found] = k;
          found += static_cast<std::size_t>(distance2[k] < cutoff * cutoff) & static_cast<std::size_t>(members[k] > i);
        }
        for (std::size_t k = 0; k < found; ++k) near.emplace_back(members[hits[k]], distance2[hits[k]]);
      }
    }
    std::sort(near.begin(), near.end());
    candidates.clear();
    for (const auto& [j, squared] : near) candidates.push_back(surface[j]);
    rule_.keep_allowed(surface[i], candidates);
    auto next_near = near.begin();
    for (const std::int32_t other : candidates) {
      while (surface[next_near->first] != other) ++next_near;
      pairs_.emplace_back(surface[i], other);
      distance_.push_back(std::sqrt(next_near->second));
      smallest_gap_m_ = std::min(smallest_gap_m_, distance_.back() - reach_m_);
    }
  }
}

/// Sorts the pairs into bins by kinds and distance.
void VerletList::put_in_order() {
  std::vector<std::size_t> bin_of;
  bin_of.reserve(pairs_.size());
  bin_begin_.assign(3 * bins + 1, 0);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto& [first, second] = pairs_[i];
    const int kinds = kind_.empty() ? 0 : kind_[static_cast<std::size_t>(first)] + kind_[static_cast<std::size_t>(second)];
    const auto bin = std::min(static_cast<std::size_t>(distance_[i] / bin_width_m()), bins - 1);
    bin_of.push_back(static_cast<std::size_t>(kinds) * bins + bin);
    ++bin_begin_[bin_of.back() + 1];
  }
  std::partial_sum(bin_begin_.begin(), bin_begin_.end(), bin_begin_.begin());
  order_.resize(pairs_.size());
  place_.resize(pairs_.size());
  first_.assign(pairs_.size() + widest_pack<float>, 0);
  second_.assign(pairs_.size() + widest_pack<float>, 0);
  std::vector<std::size_t> next(bin_begin_.begin(), bin_begin_.end() - 1);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const std::size_t place = next[bin_of[i]]++;
    order_[place] = static_cast<std::int32_t>(i);
    place_[i] = static_cast<std::int32_t>(place);
    first_[place] = pairs_[i].first;
    second_[place] = pairs_[i].second;
  }
}

std::array<double, 3> VerletList::reaches_m(const std::array<double, 2>& size_m) {
  return {collision_radius_fraction * (2.0 * size_m[0]), collision_radius_fraction * (size_m[0] + size_m[1]),
          collision_radius_fraction * (2.0 * size_m[1])};
}

std::array<std::pair<std::size_t, std::size_t>, 3> VerletList::candidates(const std::array<double, 2>& size_m,
                                                                          double further_m) const {
  const std::array<double, 3> reaches = reaches_m(size_m);
  std::array<std::pair<std::size_t, std::size_t>, 3> parts;
  for (std::size_t kinds = 0; kinds < 3; ++kinds) {
    const double farthest = reaches[kinds] + further_m + 2.0 * bound_m_ + 2e-6 * reach_m_;  // margin: rounding
    const auto bin = std::min(static_cast<std::size_t>(farthest / bin_width_m()), bins - 1);
    parts[kinds] = {bin_begin_[kinds * bins], bin_begin_[kinds * bins + bin + 1]};
  }
  return parts;
}

template <class Real>
void add_collision_loads(std::span<const std::int32_t> touching, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs,
                         const StepData<Real>& d) {
  const auto line = [](auto* lines, std::int32_t voxel) { return lines + static_cast<std::ptrdiff_t>(voxel) * line_length; };
  const auto sphere = [&](std::int32_t voxel) {
    const Real* pose = line(d.pose, voxel);
    return std::array<Real, 4>{pose[slot::x], pose[slot::y], pose[slot::z], size_m(d, static_cast<std::size_t>(voxel))};
  };
  const auto end = [&](std::int32_t voxel) {
    const Real* coefficients = line(d.voxel_table, d.voxel_class[voxel]);
    const Real* motion = line(d.motion, voxel);
    const Vector3<Real> momentum{motion[slot::px], motion[slot::py], motion[slot::pz]};
    return ContactEnd<Real>{coefficients[class_slot::inverse_mass] * momentum, coefficients[class_slot::contact_stiffness],
                            coefficients[class_slot::contact_damping]};
  };
  const auto add = [&](std::int32_t voxel, const Vector3<Real>& force) {
    Real* load = line(d.load, voxel);
    load[slot::fx] += force.x;
    load[slot::fy] += force.y;
    load[slot::fz] += force.z;
  };
  add_contact_loads<Real>(touching, pairs, sphere, end, add);
}

template void VerletList::build<double>(const double*, std::size_t);
template void VerletList::build<float>(const float*, std::size_t);
template bool VerletList::refresh<double>(const double*, std::size_t);
template bool VerletList::refresh<float>(const float*, std::size_t);
template void add_collision_loads<double>(std::span<const std::int32_t>,
                                          const std::vector<std::pair<std::int32_t, std::int32_t>>&, const StepData<double>&);
template void add_collision_loads<float>(std::span<const std::int32_t>, const std::vector<std::pair<std::int32_t, std::int32_t>>&,
                                         const StepData<float>&);

}  // namespace menger::voxel
