#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evolution/trade_off/trade_off_study.h"
#include "evolution/trade_off/trade_off_table.h"
#include "io/process/program_job.h"

namespace menger::evolution {

/// How finely a body is computed by finite elements.
struct ElementFidelity {
  int degree = 1;
  int elements_through_wall = 1;
  double bulk_ratio = 50.0;
  double force_tolerance = 1e-7;

  bool operator==(const ElementFidelity&) const = default;
};

/// All combinations of a choice, from coarse to fine: by degree times elements through the wall, then degree, then bulk ratio,
/// then the other way round by tolerance. The last that completes is the reference.
std::vector<ElementFidelity> element_fidelities(const ElementChoice& choice);

/// A row without a result yet.
TradeRow element_row(const ElementFidelity& fidelity);

/// The fidelity's run of `menger inflate` to a pressure, free but for its rigid motions.
/// @param program menger-inflate @param unknowns of count_elements, for the estimated time
io::ProgramJob element_job(const TradeStudy& study, const ElementFidelity& fidelity, double pressure_Pa,
                           const std::filesystem::path& program, std::uint64_t unknowns);

/// Reads what a run gave into a row; what cannot be read makes the row "failed" with the reason.
void read_element_result(const TradeStudy& study, const io::ProgramJobResult& result, TradeRow& row);

/// The least limit pressure (Pa) that a run met, if any. Precondition: result.has_result()
std::optional<double> limit_pressure_Pa(const io::ProgramJobResult& result);

}  // namespace menger::evolution
