#include "evolution/search/lazy_selection.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "evolution/search/age_fitness_pareto.h"

namespace menger::evolution {

namespace {

/// Returns the largest fitness that an individual may turn out to have.
std::optional<double> best_fitness(const PoolMember& individual) {
  return individual.is_decided() ? individual.fitness
                                 : individual.fitness_bound.value_or(std::numeric_limits<double>::infinity());
}

PoolMember at_best(const PoolMember& individual) {
  return {.id = individual.id, .age = individual.age, .fitness = best_fitness(individual)};
}

/// Returns whether a dominates b whatever fitness the undecided individuals turn out to have.
bool surely_dominates(const PoolMember& a, const PoolMember& b) {
  // Compares a at its worst (no fitness while it is undecided) with b at its best. Both sides never depend on the same unknown,
  // since a and b are different.
  return dominates(a, at_best(b));
}

/// Returns whether evaluations of a alone may show that a dominates b for certain.
bool may_come_to_dominate(const PoolMember& a, const PoolMember& b) {
  return !a.is_decided() && dominates(at_best(a), at_best(b));
}

/// Returns low(i) of every individual i: the least level that it may have.
std::vector<std::size_t> lowest_levels(std::span<const PoolMember> pool, std::size_t survivors) {
  std::vector<std::size_t> levels;
  levels.reserve(pool.size());
  for (const PoolMember& individual : pool) {
    const auto dominators =
        std::ranges::count_if(pool, [&](const PoolMember& other) { return surely_dominates(other, individual); });
    const bool failed = individual.is_decided() && !individual.fitness;
    levels.push_back(static_cast<std::size_t>(dominators) + (failed ? 2 * survivors : 0));
  }
  return levels;
}

/// Returns the least level that at least `survivors` individuals (or all, if there are fewer) do not exceed. Precondition: there
/// are levels, and survivors >= 1.
std::size_t filling_level(std::vector<std::size_t> levels, std::size_t survivors) {
  const auto last = levels.begin() + static_cast<std::ptrdiff_t>(std::min(survivors, levels.size()) - 1);
  std::ranges::nth_element(levels, last);
  return *last;
}

}  // namespace

SelectionOutlook outlook(std::span<const PoolMember> pool, std::size_t survivors) {
  if (pool.empty() || survivors == 0) return {};
  const std::vector<std::size_t> levels = lowest_levels(pool, survivors);
  const std::size_t filling = filling_level(levels, survivors);

  std::vector<std::size_t> blocking;
  for (std::size_t position = 0; position < pool.size(); ++position) {
    if (!pool[position].is_decided() && levels[position] <= filling) blocking.push_back(position);
  }
  std::ranges::sort(blocking, [&](std::size_t a, std::size_t b) {
    if (levels[a] != levels[b]) return levels[a] < levels[b];
    if (best_fitness(pool[a]) != best_fitness(pool[b])) return best_fitness(pool[a]) > best_fitness(pool[b]);
    if (pool[a].age != pool[b].age) return pool[a].age < pool[b].age;
    return pool[a].id > pool[b].id;
  });

  SelectionOutlook result;
  for (const std::size_t position : blocking) {
    const PoolMember& individual = pool[position];
    result.blocking.push_back(individual.id);
    const auto rivals =
        std::ranges::count_if(pool, [&](const PoolMember& other) { return may_come_to_dominate(other, individual); });
    const bool unavoidable = levels[position] + static_cast<std::size_t>(rivals) <= filling;
    if (!individual.fitness_bound || unavoidable) result.run_now.push_back(individual.id);
  }
  return result;
}

}  // namespace menger::evolution
