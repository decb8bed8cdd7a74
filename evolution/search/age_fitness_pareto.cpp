#include "evolution/search/age_fitness_pareto.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace menger::evolution {

namespace {

/// Takes members of one level until `wanted` are taken: the first one, then those at the index floor(L^u).
std::vector<std::size_t> draw_from_level(std::span<const std::size_t> level, std::size_t wanted, RandomStream& random) {
  std::vector<std::size_t> taken{level.front()};
  std::vector<bool> is_taken(level.size(), false);
  is_taken.front() = true;
  while (taken.size() < wanted) {
    // Rounding can lift L^u to L although u < 1.
    const auto index =
        std::min(static_cast<std::size_t>(std::pow(static_cast<double>(level.size()), random.uniform())), level.size() - 1);
    if (is_taken[index]) continue;
    is_taken[index] = true;
    taken.push_back(level[index]);
  }
  return taken;
}

}  // namespace

bool dominates(const PoolMember& a, const PoolMember& b) {
  // An empty optional is less than any value, so that failures rank below every fitness.
  if (a.fitness < b.fitness || a.age > b.age) return false;
  return a.fitness > b.fitness || a.age < b.age || a.id > b.id;
}

std::vector<std::size_t> domination_levels(std::span<const PoolMember> pool, std::size_t survivors) {
  std::vector<std::size_t> levels;
  levels.reserve(pool.size());
  for (const PoolMember& member : pool) {
    const auto dominators = std::ranges::count_if(pool, [&](const PoolMember& other) { return dominates(other, member); });
    levels.push_back(static_cast<std::size_t>(dominators) + (member.fitness ? 0 : 2 * survivors));
  }
  return levels;
}

std::vector<std::size_t> selection_order(std::span<const PoolMember> pool, std::size_t survivors) {
  const std::vector<std::size_t> levels = domination_levels(pool, survivors);
  std::vector<std::size_t> order(pool.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    if (levels[a] != levels[b]) return levels[a] < levels[b];
    if (pool[a].fitness != pool[b].fitness) return pool[a].fitness > pool[b].fitness;
    if (pool[a].age != pool[b].age) return pool[a].age < pool[b].age;
    return pool[a].id > pool[b].id;
  });
  return order;
}

std::vector<std::uint64_t> select_survivors(std::span<const PoolMember> pool, std::size_t survivors, RandomStream& random) {
  const std::vector<std::size_t> levels = domination_levels(pool, survivors);
  const std::vector<std::size_t> order = selection_order(pool, survivors);
  std::vector<std::uint64_t> taken;
  for (std::size_t begin = 0; begin < order.size() && taken.size() < survivors;) {
    std::size_t end = begin;
    while (end < order.size() && levels[order[end]] == levels[order[begin]]) ++end;
    const std::span<const std::size_t> level(order.data() + begin, end - begin);
    const std::size_t room = survivors - taken.size();
    if (level.size() <= room) {
      for (const std::size_t position : level) taken.push_back(pool[position].id);
    } else {
      for (const std::size_t position : draw_from_level(level, room, random)) taken.push_back(pool[position].id);
    }
    begin = end;
  }
  return taken;
}

}  // namespace menger::evolution
