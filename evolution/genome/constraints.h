#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "evolution/genome/decoder.h"

namespace menger::evolution {

/// What happens to a body if one of its aggregates falls apart.
enum class DisconnectedPolicy {
  reject,    ///< it is not valid: drawn again at birth, refused as a child
  penalise,  ///< it is valid but has no fitness and is never simulated, so it ranks below all bodies with a fitness
  allow      ///< it is simulated in pieces
};
std::string_view to_string(DisconnectedPolicy policy);  ///< "reject", "penalise" or "allow"

/// Which bodies are valid.
struct ConstraintOptions {
  std::size_t smallest_body = 3;            ///< fractal plans: least number of cells of the basal body
  std::size_t smallest_arranged_body = 27;  ///< non-fractal plan: least number of cells of the level-3 body
  DisconnectedPolicy disconnected = DisconnectedPolicy::reject;
  std::vector<int> levels{1, 2, 3};  ///< levels at which the study evaluates a body, each >= 1
  /// Only bodies that can be cast are valid: in one piece, without cells that touch only along an edge or at a corner.
  bool castable = false;
  std::size_t largest_body = 27;  ///< fractal plans: largest number of cells of the basal body

  bool operator==(const ConstraintOptions&) const = default;
};

/// Returns whether `mask` is face-connected after every occupied cell is replaced by `block`. Equals
/// is_connected(replace_cells(mask, block)) for any two bodies, but does not build that body: it joins the components of
/// neighbouring copies of the block where their faces touch.
bool replacement_is_connected(const meshes::Polycube& mask, const meshes::Polycube& block);

/// Returns whether the body of a level is face-connected.
///
/// For a fractal, level 2 decides for every higher level. Proof: call an axis of the connected basal body B conducting if two
/// copies of B that are neighbours along it touch. Let B' be B with only the neighbourhoods along conducting axes. Level 2 is
/// connected exactly if B' is. If B' is connected, so is A' for the body A of every level, by induction: each copy of B in A is
/// connected, since B' is, and copies that are neighbours along a conducting axis touch along that axis. Hence the next level is
/// connected. If a level is not connected, the next one is not either, because copies of B in different components are not
/// neighbours.
bool aggregate_is_connected(const Phenotype& phenotype, int level);

/// Returns whether the aggregate at one of the levels of the study falls apart.
bool falls_apart(const Phenotype& phenotype, const ConstraintOptions& options);

/// Why a design is not valid.
enum class Refusal {
  too_small,    ///< fewer cells than the smallest body
  too_large,    ///< more cells than the largest body
  falls_apart,  ///< in pieces at a level where it must be connected
  weak_contact  ///< two cells of the basal body touch only along an edge or at a corner: no casting
};
std::string_view to_string(Refusal refusal);  ///< "too small", "too large", "falls apart" or "weak contact"

/// Returns the first reason why a design is not valid, or nothing if it is valid.
///
/// The basal body of a fractal must have smallest_body to largest_body cells. With arrangements, the level-3 body must have at
/// least smallest_arranged_body cells and must be connected, whatever levels the study evaluates. With
/// DisconnectedPolicy::reject, no aggregate at a level of the study may fall apart either. With `castable`, whatever the policy,
/// the basal body must be one that meshes::check_design accepts for casting, and no aggregate at a level of the study may fall
/// apart.
std::optional<Refusal> refusal(const Phenotype& phenotype, const ConstraintOptions& options);

/// Returns whether a design is valid: it has no Refusal.
inline bool is_valid(const Phenotype& phenotype, const ConstraintOptions& options) { return !refusal(phenotype, options); }

/// Returns whether a design gets no fitness and no simulation: it falls apart, and the policy is DisconnectedPolicy::penalise.
bool is_penalised(const Phenotype& phenotype, const ConstraintOptions& options);

}  // namespace menger::evolution
