#include "meshes/load_cases/body_feet.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace menger::meshes {
namespace {

using Place = std::array<double, 3>;

/// Returns places about their mean.
std::vector<Place> about_mean(const std::vector<Place>& places) {
  Place mean{};
  for (const Place& place : places) {
    for (std::size_t i = 0; i < 3; ++i) mean[i] += place[i] / static_cast<double>(places.size());
  }
  std::vector<Place> result = places;
  for (Place& place : result) {
    for (std::size_t i = 0; i < 3; ++i) place[i] -= mean[i];
  }
  return result;
}

bool touch(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) == 1;
}

}  // namespace

std::vector<std::vector<std::size_t>> feet_of(const std::vector<std::array<int, 3>>& cells) {
  std::vector<std::vector<std::size_t>> feet;
  if (cells.empty()) return feet;
  int lowest = cells.front()[2];
  for (const auto& cell : cells) lowest = std::min(lowest, cell[2]);
  std::vector<bool> taken(cells.size(), false);
  for (std::size_t first = 0; first < cells.size(); ++first) {
    if (taken[first] || cells[first][2] != lowest) continue;
    std::vector<std::size_t> foot{first};
    taken[first] = true;
    for (std::size_t n = 0; n < foot.size(); ++n) {
      for (std::size_t other = 0; other < cells.size(); ++other) {
        if (taken[other] || cells[other][2] != lowest || !touch(cells[foot[n]], cells[other])) continue;
        foot.push_back(other);
        taken[other] = true;
      }
    }
    std::ranges::sort(foot);
    feet.push_back(foot);
  }
  return feet;
}

std::vector<double> feet_outwards_m(const std::vector<Place>& at_rest, const std::vector<Place>& deformed,
                                    const EndPoints& ends_at_rest, const EndPoints& ends_deformed) {
  const auto R = rotation_of_body(ends_at_rest, ends_deformed);
  const std::vector<Place> before = about_mean(at_rest);
  const std::vector<Place> after = about_mean(deformed);
  std::vector<double> outwards;
  outwards.reserve(before.size());
  for (std::size_t foot = 0; foot < before.size(); ++foot) {
    const auto& [X, Y, Z] = before[foot];
    const double distance = std::hypot(X, Y);
    // Rounding leaves a foot in the middle some 1e-17 m away from it.
    if (!(distance > 1e-9 * std::abs(ends_at_rest[2][1][2] - ends_at_rest[2][0][2]))) {
      outwards.push_back(0.0);
      continue;
    }
    std::array<double, 2> turned_back{};
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t i = 0; i < 3; ++i) turned_back[k] += R[i][k] * after[foot][i];
    }
    outwards.push_back((X * turned_back[0] + Y * turned_back[1]) / distance - distance);
  }
  return outwards;
}

}  // namespace menger::meshes
