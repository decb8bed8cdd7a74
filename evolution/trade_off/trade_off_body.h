#pragma once

#include <cstdint>

#include "evolution/trade_off/trade_off_elements.h"
#include "evolution/trade_off/trade_off_study.h"
#include "meshes/design/hollow_body_options.h"

namespace menger::evolution {

meshes::ChamberLayout chamber_layout(const TradeStudy& study);

/// Returns how the design of a study is cast and meshed.
meshes::HollowBodyOptions hollow_options(const TradeStudy& study, const ElementFidelity& fidelity);

/// The size of a finite-element problem on a mesh of the design, known before anything is computed.
struct ElementCount {
  std::uint64_t elements = 0;
  std::uint64_t unknowns =
      0;  ///< displacements, three per node: corners; from degree 2 on, middles of edges, faces, elements too
};

/// Meshes the design and counts elements and unknowns. @throws io::InputError as meshes::hollow_polycube does
ElementCount count_elements(const TradeStudy& study, const ElementFidelity& fidelity);

}  // namespace menger::evolution
