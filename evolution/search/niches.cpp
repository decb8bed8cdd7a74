#include "evolution/search/niches.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "evolution/genome/robot_form.h"
#include "evolution/search/age_fitness_pareto.h"

namespace menger::evolution {

namespace {

/// Returns the number of groups of cells in the lowest layer of a standing body.
std::size_t count_of_feet(const meshes::Polycube& body) {
  std::vector<meshes::CellIndex> left;
  for (const meshes::CellIndex& cell : body.occupied())
    if (cell.z == 0) left.push_back(cell);
  const auto are_joined = [](const meshes::CellIndex& a, const meshes::CellIndex& b) {
    return std::abs(a.x - b.x) + std::abs(a.y - b.y) == 1;
  };
  std::size_t feet = 0;
  while (!left.empty()) {
    ++feet;
    std::vector<meshes::CellIndex> reached{left.back()};
    left.pop_back();
    while (!reached.empty()) {
      const meshes::CellIndex from = reached.back();
      reached.pop_back();
      const auto joined = std::partition(left.begin(), left.end(), [&](const auto& cell) { return !are_joined(from, cell); });
      reached.insert(reached.end(), joined, left.end());
      left.erase(joined, left.end());
    }
  }
  return feet;
}

double best_of(const PoolMember& member) { return member.fitness_bound.value_or(std::numeric_limits<double>::infinity()); }

/// Returns a member as it would be with the largest fitness that it may have.
PoolMember with_bound(const PoolMember& member) {
  PoolMember best = member;
  best.fitness = best_of(member);
  return best;
}

/// Returns the fittest decided member; null if none has a fitness.
const PoolMember* fittest(const std::vector<const PoolMember*>& members) {
  const PoolMember* best = nullptr;
  for (const PoolMember* member : members) {
    if (!member->is_decided() || !member->fitness) continue;
    if (best == nullptr || is_fitter(*member, *best)) best = member;
  }
  return best;
}

}  // namespace

Niche niche_of(const MapElitesPlan& plan, const meshes::Polycube& body) {
  const meshes::Polycube upright = standing(body);
  int layers = 0;
  for (const meshes::CellIndex& cell : upright.occupied()) layers = std::max(layers, cell.z + 1);
  const std::size_t cells = upright.count();
  return {.fewest_cells = cells - (cells - 1) % plan.cells_per_niche, .feet = count_of_feet(upright), .layers = layers};
}

void Selection::add(std::uint64_t id, const Phenotype& phenotype) {
  if (plan_.map_elites) niches_[id] = niche_of(*plan_.map_elites, phenotype.body);
}

Selection::ByNiche Selection::by_niche(std::span<const PoolMember> pool) const {
  ByNiche members;
  for (const PoolMember& member : pool) members[niches_.at(member.id)].push_back(&member);
  return members;
}

SelectionOutlook Selection::outlook(std::span<const PoolMember> pool) const {
  if (!plan_.map_elites) return evolution::outlook(pool, static_cast<std::size_t>(plan_.survivors));
  SelectionOutlook view;
  for (const auto& [niche, members] : by_niche(pool)) {
    const PoolMember* best = fittest(members);
    std::vector<PoolMember> blocking;
    for (const PoolMember* member : members) {
      if (member->is_decided()) continue;
      if (best == nullptr || is_fitter(with_bound(*member), *best)) blocking.push_back(with_bound(*member));
    }
    std::ranges::sort(blocking, is_fitter);
    for (std::size_t n = 0; n < blocking.size(); ++n) {
      view.blocking.push_back(blocking[n].id);
      if (n == 0 || !blocking[n].fitness_bound) view.run_now.push_back(blocking[n].id);
    }
  }
  return view;
}

std::vector<std::uint64_t> Selection::select(std::span<const PoolMember> pool, RandomStream& random) const {
  const auto survivors = static_cast<std::size_t>(plan_.survivors);
  if (!plan_.map_elites) return select_survivors(pool, survivors, random);
  std::vector<std::uint64_t> selected;
  for (const auto& [niche, members] : by_niche(pool))
    if (const PoolMember* best = fittest(members)) selected.push_back(best->id);
  if (!selected.empty()) return selected;
  for (const PoolMember& member : pool) selected.push_back(member.id);
  std::ranges::sort(selected, std::ranges::greater{});
  selected.resize(std::min(selected.size(), survivors));
  return selected;
}

}  // namespace menger::evolution
