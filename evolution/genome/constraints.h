#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "evolution/genome/decoder.h"

namespace menger::evolution {

/// What happens to a body some aggregate of which falls apart.
enum class DisconnectedPolicy {
  reject,    ///< it is not valid: redrawn at birth, refused as a child
  penalise,  ///< it is valid but has no fitness and is never simulated, so it ranks behind all that have one
  allow      ///< it is simulated in pieces
};
std::string_view to_string(DisconnectedPolicy policy);  ///< "reject", "penalise" or "allow"

struct ConstraintOptions {
  std::size_t smallest_body = 3;            ///< fractal plans: cells of the basal body, at least
  std::size_t smallest_arranged_body = 27;  ///< non-fractal plan: cells of the level-3 body, at least
  DisconnectedPolicy disconnected = DisconnectedPolicy::reject;
  std::vector<int> levels{1, 2, 3};  ///< levels at which the study judges a body, each >= 1
  bool castable = false;  ///< only bodies that can be cast: in one piece, without cells that touch only along an edge or at a
                          ///< corner

  bool operator==(const ConstraintOptions&) const = default;
};

/// Whether `mask` with every occupied cell replaced by `block` is face-connected, without building it: the components of the
/// block are joined over the faces of neighbouring cells only. Agrees with is_connected(replace_cells(mask, block)), for any two
/// bodies.
bool replacement_is_connected(const meshes::Polycube& mask, const meshes::Polycube& block);

/// Whether the body of a level is face-connected.
///
/// A fractal is decided at level 2 for every higher level. Call an axis of the connected basal body B conducting if two copies of
/// B that are neighbours along it touch, and let B' be B with only the neighbourhoods along conducting axes. Level 2 is connected
/// exactly when B' is. If B' is connected, so is A' for every level A by induction: each copy of B in it is (B' is), and copies
/// that are neighbours along a conducting axis touch along that axis; hence the next level is connected. If a level is not
/// connected, the next one is not either, because copies of B in different components are no neighbours.
bool aggregate_is_connected(const Phenotype& phenotype, int level);

/// Whether an aggregate at one of the levels of the study falls apart.
bool falls_apart(const Phenotype& phenotype, const ConstraintOptions& options);

/// Why a design may not live.
enum class Refusal {
  too_small,    ///< fewer cells than the smallest body
  falls_apart,  ///< in pieces at a level where it must not be
  weak_contact  ///< two cells of the basal body touch only along an edge or at a corner: no casting
};
std::string_view to_string(Refusal refusal);  ///< "too small", "falls apart" or "weak contact"

/// The first reason against a design, or nothing if it may live. A fractal's basal body must not be smaller than the smallest
/// one. With arrangements it is the level-3 body that must not be smaller than its smallest one and that must be connected, at
/// whatever levels the study judges it. With DisconnectedPolicy::reject, moreover, no aggregate at a level of the study may fall
/// apart. With `castable` the basal body must be what meshes::check_design casts, whatever the policy, and no aggregate may fall
/// apart.
std::optional<Refusal> refusal(const Phenotype& phenotype, const ConstraintOptions& options);

/// Whether a design may live: there is no reason against it.
inline bool is_valid(const Phenotype& phenotype, const ConstraintOptions& options) { return !refusal(phenotype, options); }

/// Whether the design lives without a fitness and without simulation: DisconnectedPolicy::penalise and falls_apart.
bool is_penalised(const Phenotype& phenotype, const ConstraintOptions& options);

}  // namespace menger::evolution
