#include "evolution/search/lazy_selection.h"

#include <algorithm>

namespace menger::evolution {

namespace {

/// An individual at the best fitness it may have.
Contestant at_best(const PartialContestant& individual) {
  return {individual.id, individual.age, individual.decided ? individual.fitness : std::optional(individual.bound)};
}

/// Whether a dominates b whatever the fitness of undecided ones turns out to be.
bool surely_dominates(const PartialContestant& a, const PartialContestant& b) {
  // a at its worst against b at its best; one and the same unknown does not stand on both sides, since a and b are different.
  const Contestant worst{a.id, a.age, a.decided ? a.fitness : std::nullopt};
  return dominates(worst, at_best(b));
}

/// Whether a can come to dominate b for certain by evaluations of a alone.
bool may_come_to_dominate(const PartialContestant& a, const PartialContestant& b) {
  return !a.decided && dominates(at_best(a), at_best(b));
}

/// The least level that any outcome of what is unknown leaves to each individual.
std::vector<std::size_t> lowest_levels(std::span<const PartialContestant> pool, std::size_t survivors) {
  std::vector<std::size_t> levels;
  levels.reserve(pool.size());
  for (const PartialContestant& individual : pool) {
    const auto dominators =
        std::ranges::count_if(pool, [&](const PartialContestant& other) { return surely_dominates(other, individual); });
    const bool failed = individual.decided && !individual.fitness;
    levels.push_back(static_cast<std::size_t>(dominators) + (failed ? 2 * survivors : 0));
  }
  return levels;
}

/// The least level that at least `survivors` individuals (or all there are) do not exceed. Precondition: neither is 0.
std::size_t filling_level(std::vector<std::size_t> levels, std::size_t survivors) {
  const auto last = levels.begin() + static_cast<std::ptrdiff_t>(std::min(survivors, levels.size()) - 1);
  std::ranges::nth_element(levels, last);
  return *last;
}

}  // namespace

SelectionOutlook outlook(std::span<const PartialContestant> pool, std::size_t survivors) {
  if (pool.empty() || survivors == 0) return {};
  const std::vector<std::size_t> levels = lowest_levels(pool, survivors);
  const std::size_t filling = filling_level(levels, survivors);

  std::vector<std::size_t> blocking;
  for (std::size_t position = 0; position < pool.size(); ++position) {
    if (!pool[position].decided && levels[position] <= filling) blocking.push_back(position);
  }
  std::ranges::sort(blocking, [&](std::size_t a, std::size_t b) {
    if (levels[a] != levels[b]) return levels[a] < levels[b];
    if (pool[a].bound != pool[b].bound) return pool[a].bound > pool[b].bound;
    if (pool[a].age != pool[b].age) return pool[a].age < pool[b].age;
    return pool[a].id > pool[b].id;
  });

  SelectionOutlook result;
  for (const std::size_t position : blocking) {
    const PartialContestant& individual = pool[position];
    result.blocking.push_back(individual.id);
    const auto rivals =
        std::ranges::count_if(pool, [&](const PartialContestant& other) { return may_come_to_dominate(other, individual); });
    const bool unavoidable = levels[position] + static_cast<std::size_t>(rivals) <= filling;
    if (individual.untouched() || unavoidable) result.run_now.push_back(individual.id);
  }
  return result;
}

std::vector<Contestant> settled(std::span<const PartialContestant> pool) {
  std::vector<Contestant> contestants;
  contestants.reserve(pool.size());
  for (const PartialContestant& individual : pool) {
    contestants.push_back({individual.id, individual.age, individual.decided ? individual.fitness : std::nullopt});
  }
  return contestants;
}

}  // namespace menger::evolution
