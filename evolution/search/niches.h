#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "evolution/archive/pool_member.h"
#include "evolution/genome/decoder.h"
#include "evolution/genome/random_stream.h"
#include "evolution/search/lazy_selection.h"
#include "evolution/search/search_plan.h"

namespace menger::evolution {

/// The kind of a body: bodies of one niche compete with each other alone. @cite mouret2015illuminating
struct Niche {
  std::size_t fewest_cells = 0;  ///< of its range of sizes, which ends before that of the next
  std::size_t feet = 0;          ///< separate groups of cells in the lowest layer, joined face to face
  int layers = 0;                ///< height in cells

  auto operator<=>(const Niche&) const = default;  // NOLINT(modernize-use-nullptr): taken for a comparison with 0
};

/// Returns the niche of a body. It is the same wherever the body grew. @param body not empty
Niche niche_of(const MapElitesPlan& plan, const meshes::Polycube& body);

/// Selects the survivors of a pool: by age and fitness (select_survivors), or with plan.map_elites the fittest of every niche.
///
/// With niches, a niche without a fitness has no survivor. If no member has a fitness, the newest survive, as many as the plan
/// says. Nothing is drawn at random.
class Selection {
 public:
  /// Keeps a reference to the plan.
  explicit Selection(const SearchPlan& plan) : plan_(plan) {}

  /// Makes a member of the pool known. Only then it can be selected.
  void add(std::uint64_t id, const Phenotype& phenotype);

  /// Returns whether selection is settled, and what to evaluate next. With niches, an undecided member matters while its bound is
  /// above the fittest decided member of its niche. Of a niche, those run now that have no bound, or else the one of the largest:
  /// nothing but its own evaluation can settle it.
  [[nodiscard]] SelectionOutlook outlook(std::span<const PoolMember> pool) const;

  /// Returns the ids of the survivors: in the order of select_survivors, or by niche.
  [[nodiscard]] std::vector<std::uint64_t> select(std::span<const PoolMember> pool, RandomStream& random) const;

 private:
  using ByNiche = std::map<Niche, std::vector<const PoolMember*>>;
  [[nodiscard]] ByNiche by_niche(std::span<const PoolMember> pool) const;

  const SearchPlan& plan_;
  std::map<std::uint64_t, Niche> niches_;
};

}  // namespace menger::evolution
