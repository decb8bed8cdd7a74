#include "evolution/genome/constraints.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "meshes/design/connectivity.h"
#include "meshes/design/weak_contacts.h"

namespace menger::evolution {

namespace {

using meshes::CellIndex;
using meshes::Polycube;

constexpr std::array<CellIndex, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

std::size_t offset_in(const Polycube& grid, const CellIndex& cell) {
  const auto number = [](int count) { return static_cast<std::size_t>(count); };
  return number(cell.x) + number(grid.nx()) * (number(cell.y) + number(grid.ny()) * number(cell.z));
}

std::size_t grid_size(const Polycube& grid) { return offset_in(grid, {grid.nx() - 1, grid.ny() - 1, grid.nz() - 1}) + 1; }

/// Disjoint sets (union-find) of the numbers below a count.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), std::size_t{0}); }

  std::size_t root(std::size_t item) {
    while (parents_[item] != item) item = parents_[item] = parents_[parents_[item]];
    return item;
  }

  void join(std::size_t a, std::size_t b) { parents_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parents_;
};

/// The face-connected components of a block: the number of each occupied cell's component, and how many components there are.
struct Components {
  std::vector<std::size_t> numbers;
  std::size_t count = 0;
};

Components components_of(const Polycube& block, const std::vector<CellIndex>& cells) {
  const std::size_t grid = grid_size(block);
  DisjointSets sets(grid);
  for (const CellIndex& cell : cells) {
    for (const auto& [dx, dy, dz] : axes) {
      const CellIndex next{cell.x + dx, cell.y + dy, cell.z + dz};
      if (block.at_or_empty(next) != meshes::empty) sets.join(offset_in(block, cell), offset_in(block, next));
    }
  }
  Components components{std::vector<std::size_t>(grid), 0};
  for (const CellIndex& cell : cells) {
    const std::size_t offset = offset_in(block, cell);
    if (sets.root(offset) == offset) components.numbers[offset] = components.count++;
  }
  for (const CellIndex& cell : cells) {
    const std::size_t offset = offset_in(block, cell);
    components.numbers[offset] = components.numbers[sets.root(offset)];
  }
  return components;
}

/// Pairs of components that touch: one of a block, one of the next copy of the block along an axis.
using Contacts = std::set<std::pair<std::size_t, std::size_t>>;

std::array<Contacts, 3> contacts_of(const Polycube& block, const std::vector<CellIndex>& cells, const Components& components) {
  std::array<Contacts, 3> contacts;
  const auto touch = [&](std::size_t axis, const CellIndex& cell, const CellIndex& next) {
    if (block.at(next) == meshes::empty) return;
    contacts[axis].emplace(components.numbers[offset_in(block, cell)], components.numbers[offset_in(block, next)]);
  };
  for (const CellIndex& cell : cells) {
    if (cell.x == block.nx() - 1) touch(0, cell, {0, cell.y, cell.z});
    if (cell.y == block.ny() - 1) touch(1, cell, {cell.x, 0, cell.z});
    if (cell.z == block.nz() - 1) touch(2, cell, {cell.x, cell.y, 0});
  }
  return contacts;
}

}  // namespace

std::string_view to_string(DisconnectedPolicy policy) {
  switch (policy) {
    case DisconnectedPolicy::reject:
      return "reject";
    case DisconnectedPolicy::penalise:
      return "penalise";
    case DisconnectedPolicy::allow:
      return "allow";
  }
  return {};
}

bool replacement_is_connected(const Polycube& mask, const Polycube& block) {
  const std::vector<CellIndex> places = mask.occupied();
  const std::vector<CellIndex> cells = block.occupied();
  if (places.empty() || cells.empty()) return false;
  const Components components = components_of(block, cells);
  const auto contacts = contacts_of(block, cells, components);

  std::vector<std::size_t> numbers(grid_size(mask));
  for (std::size_t number = 0; number < places.size(); ++number) numbers[offset_in(mask, places[number])] = number;
  DisjointSets sets(places.size() * components.count);
  std::size_t parts = places.size() * components.count;
  for (std::size_t number = 0; number < places.size(); ++number) {
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      const auto& [dx, dy, dz] = axes[axis];
      const CellIndex next{places[number].x + dx, places[number].y + dy, places[number].z + dz};
      if (mask.at_or_empty(next) == meshes::empty) continue;
      for (const auto& [near, far] : contacts[axis]) {
        const std::size_t a = sets.root(number * components.count + near);
        const std::size_t b = sets.root(numbers[offset_in(mask, next)] * components.count + far);
        if (a == b) continue;
        sets.join(a, b);
        --parts;
      }
    }
  }
  return parts == 1;
}

bool aggregate_is_connected(const Phenotype& phenotype, int level) {
  if (level <= 1) return meshes::is_connected(phenotype.body);
  if (!phenotype.has_arrangements()) return replacement_is_connected(phenotype.body, phenotype.body);
  if (level == 2) return replacement_is_connected(phenotype.arrangement, phenotype.body);
  return replacement_is_connected(phenotype.arrangement_of_arrangements, aggregate(phenotype, 2));
}

bool falls_apart(const Phenotype& phenotype, const ConstraintOptions& options) {
  return std::ranges::any_of(options.levels, [&](int level) { return !aggregate_is_connected(phenotype, level); });
}

std::string_view to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::too_small:
      return "too small";
    case Refusal::too_large:
      return "too large";
    case Refusal::falls_apart:
      return "falls apart";
    case Refusal::weak_contact:
      return "weak contact";
  }
  return {};
}

std::optional<Refusal> refusal(const Phenotype& phenotype, const ConstraintOptions& options) {
  const bool arranged = phenotype.has_arrangements();
  const std::size_t cells = arranged ? aggregate_cell_count(phenotype, largest_arranged_level) : phenotype.body.count();
  const std::size_t smallest = arranged ? options.smallest_arranged_body : options.smallest_body;
  if (cells == 0 || cells < smallest) return Refusal::too_small;
  if (!arranged && cells > options.largest_body) return Refusal::too_large;
  if (arranged && !aggregate_is_connected(phenotype, largest_arranged_level)) return Refusal::falls_apart;
  const bool must_hold = options.castable || options.disconnected == DisconnectedPolicy::reject;
  if (must_hold && falls_apart(phenotype, options)) return Refusal::falls_apart;
  if (options.castable && !meshes::is_connected(phenotype.body)) return Refusal::falls_apart;
  if (options.castable && meshes::first_weak_contact(phenotype.body)) return Refusal::weak_contact;
  return std::nullopt;
}

bool is_penalised(const Phenotype& phenotype, const ConstraintOptions& options) {
  return options.disconnected == DisconnectedPolicy::penalise && falls_apart(phenotype, options);
}

}  // namespace menger::evolution
