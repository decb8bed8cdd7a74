#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace menger::evolution {

/// How well the fitness of an individual is known when survivors are selected.
enum class Knowledge {
  evaluated,  ///< at all levels
  failed,     ///< an evaluation did not complete: no fitness
  bounded,    ///< at some levels or none; in a finished generation that is enough to know that it does not survive
  duplicate,  ///< an earlier individual had the same phenotype, and duplicates are culled: no fitness
  penalised,  ///< it falls apart: no fitness
  screened    ///< a surrogate ranked it too low to be evaluated: no fitness
};
std::string_view to_string(Knowledge knowledge);

/// An individual in the pool of a generation, for selection and for the archive.
struct PoolMember {
  std::uint64_t id = 0;           ///< of the individual: unique, a newer individual has a larger one
  int age = 0;                    ///< generations of its lineage; less is better
  std::optional<double> fitness;  ///< exists exactly for `evaluated`; more is better, and none is worse than any number

  Knowledge knowledge = Knowledge::evaluated;
  std::optional<double> fitness_bound{};       ///< for `bounded`: the fitness is at most this; none: nothing was evaluated yet
  std::optional<std::size_t> survivor_rank{};  ///< position among the survivors; none: culled

  /// Returns whether no further evaluation can change the fitness.
  [[nodiscard]] bool is_decided() const { return knowledge != Knowledge::bounded; }

  bool operator==(const PoolMember&) const = default;
};

/// Returns whether a comes before b: it has the larger fitness, or if equal the smaller age, or if equal the larger id.
bool is_fitter(const PoolMember& a, const PoolMember& b);

}  // namespace menger::evolution
