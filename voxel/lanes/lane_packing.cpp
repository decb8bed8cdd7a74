#include "voxel/lanes/lane_packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "voxel/engine/time_step.h"
#include "voxel/kernels/instruction_sets.h"
#include "voxel/model/actuation.h"

namespace menger::voxel {

namespace {

/// The number of cells of a body that another body does not have.
std::size_t cells_beyond(const std::vector<bool>& body, const std::vector<bool>& other) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i] && (other.empty() || !other[i])) ++count;
  }
  return count;
}

/// Adds the cells of a body to a set of cells.
void unite(std::vector<bool>& all, const std::vector<bool>& body) {
  if (all.empty()) all.assign(body.size(), false);
  for (std::size_t i = 0; i < body.size(); ++i) all[i] = all[i] || body[i];
}

/// Number of voxels of a body, and of beams along each axis.
struct BodyCount {
  std::size_t voxels = 0;
  std::array<std::size_t, 3> beams{};
};

BodyCount counted(const std::vector<bool>& cells, const std::array<int, 3>& grid) {
  BodyCount body;
  const auto [nx, ny, nz] = grid;
  const std::array<int, 3> stride{1, nx, nx * ny};
  for (int z = 0, i = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x, ++i) {
        if (!cells[static_cast<std::size_t>(i)]) continue;
        ++body.voxels;
        const std::array<bool, 3> inside{x + 1 < nx, y + 1 < ny, z + 1 < nz};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const int next = i + stride[axis];
          if (inside[axis] && cells[static_cast<std::size_t>(next)]) ++body.beams[axis];
        }
      }
    }
  }
  return body;
}

std::size_t rounded_up(std::size_t count, std::size_t share) { return (count + share - 1) / share; }

double registers(std::size_t numbers, std::size_t lanes) { return static_cast<double>(rounded_up(numbers, lanes)); }

// Times measured with AVX-512, in units of the time of one beam pack of robots in lanes. They only rank the two methods.
constexpr double lane_voxel = 0.4;
constexpr double beam_register = 1.8;  ///< of one robot, whose beams are first sorted into the register
constexpr double voxel_register = 0.8;
constexpr double narrow = 0.65;  ///< for a register with a quarter of the lanes

}  // namespace

bool runs_in_lanes(const Physics& physics) {
  const bool is_sine = !is_driven(physics.actuation) || !is_shaped(physics.actuation);
  return !physics.surrogate && effective_coupling(physics) == 0.0 && is_sine;
}

std::vector<bool> cells_of(const std::array<int, 3>& grid, const std::vector<meshes::CellIndex>& cells) {
  const auto [nx, ny, nz] = grid;
  std::vector<bool> has(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz), false);
  for (const meshes::CellIndex& cell : cells) {
    const int place = cell.x + nx * (cell.y + ny * cell.z);
    has[static_cast<std::size_t>(place)] = true;
  }
  return has;
}

std::vector<std::size_t> register_shares(std::size_t robots, std::size_t lanes, std::size_t workers) {
  const std::size_t rounds = rounded_up(rounded_up(robots, lanes), workers);
  const std::size_t count = std::min(robots, rounds * workers);
  std::vector<std::size_t> shares;
  for (std::size_t left = robots, n = count; n > 0; --n) {
    shares.push_back(rounded_up(left, n));
    left -= shares.back();
  }
  return shares;
}

std::vector<std::size_t> take_similar(std::span<const std::vector<bool>> cells, std::vector<std::size_t>& left,
                                      std::size_t count) {
  std::vector<std::size_t> taken;
  std::vector<bool> all;
  while (taken.size() < count && !left.empty()) {
    auto best = left.begin();
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    std::ptrdiff_t most_voxels = 0;
    for (auto one = left.begin(); one != left.end(); ++one) {
      const std::vector<bool>& body = cells[*one];
      const std::size_t added = taken.empty() ? 0 : cells_beyond(body, all);
      const std::ptrdiff_t voxels = std::count(body.begin(), body.end(), true);
      if (added > fewest || (added == fewest && voxels <= most_voxels)) continue;
      best = one;
      fewest = added;
      most_voxels = voxels;
    }
    unite(all, cells[*best]);
    taken.push_back(*best);
    left.erase(best);
  }
  return taken;
}

bool lanes_pay(std::span<const std::vector<bool>> cells, const std::array<int, 3>& grid, std::size_t lanes) {
  double alone = 0.0;
  std::vector<bool> all;
  for (const std::vector<bool>& body : cells) {
    const BodyCount own = counted(body, grid);
    alone += voxel_register * registers(own.voxels, lanes);
    for (const std::size_t beams : own.beams) alone += beam_register * registers(beams, lanes);
    unite(all, body);
  }
  const BodyCount shared = counted(all, grid);
  const double together =
      static_cast<double>(shared.beams[0] + shared.beams[1] + shared.beams[2]) + lane_voxel * static_cast<double>(shared.voxels);
  return cells.size() > 1 && (4 * cells.size() <= lanes ? narrow : 1.0) * together < alone;
}

std::vector<std::vector<std::size_t>> lane_groups(std::span<const meshes::Polycube* const> bodies, double cell_edge_m,
                                                  const Physics& physics, int workers) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::pair<std::array<int, 3>, double>, std::vector<std::size_t>> kinds;
  std::vector<std::vector<bool>> cells;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const meshes::Polycube& body = *bodies[i];
    const std::array<int, 3> grid{body.nx(), body.ny(), body.nz()};
    cells.push_back(cells_of(grid, body.occupied()));
    if (runs_in_lanes(physics)) {
      kinds[{grid, recommended_time_step_s(body, cell_edge_m, physics)}].push_back(i);
    } else {
      groups.push_back({i});
    }
  }
  const std::size_t lanes = most_lanes_of(physics.integration.number, InstructionSet::best);
  for (auto& [kind, left] : kinds) {
    for (const std::size_t share : register_shares(left.size(), lanes, static_cast<std::size_t>(workers))) {
      std::vector<std::size_t> group = take_similar(cells, left, share);
      std::vector<std::vector<bool>> of_group;
      of_group.reserve(group.size());
      for (const std::size_t i : group) of_group.push_back(cells[i]);
      if (lanes_pay(of_group, kind.first, lanes)) {
        groups.push_back(std::move(group));
      } else {
        for (const std::size_t i : group) groups.push_back({i});
      }
    }
  }
  return groups;
}

}  // namespace menger::voxel
