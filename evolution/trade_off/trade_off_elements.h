#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evolution/trade_off/trade_off_study.h"
#include "evolution/trade_off/trade_off_table.h"
#include "io/process/program_job.h"

namespace menger::evolution {

/// The fidelity of a computation by finite elements.
struct ElementFidelity {
  int degree = 1;  ///< of three-field elements, as is the next
  int elements_through_wall = 1;
  double bulk_ratio = 50.0;
  double force_tolerance = 1e-7;
  std::optional<fem::Fidelity> thin_walls{};  ///< of thin-wall elements; degree and elements through the wall are then 1

  bool operator==(const ElementFidelity&) const = default;
};

/// Returns all combinations of a choice, from coarse to fine: thin walls by their fidelity; then three-field elements by degree
/// times elements through the wall, then by degree; then by bulk ratio, then by tolerance from large to small. The last that
/// completes is the reference.
std::vector<ElementFidelity> element_fidelities(const ElementChoice& choice);

/// Makes a row without a result yet.
TradeRow element_row(const ElementFidelity& fidelity);

/// Makes the job for `menger inflate` that inflates the body to a pressure. The body is free; only its rigid motions are
/// supported.
/// @param program menger-inflate
/// @param unknowns from count_elements, for the estimated time
io::ProgramJob element_job(const TradeStudy& study, const ElementFidelity& fidelity, double pressure_Pa,
                           const std::filesystem::path& program, std::uint64_t unknowns);

/// Reads the result of a run into a row. @throws io::InputError if it cannot be read
void read_element_result(const TradeStudy& study, const io::ProgramJobResult& result, TradeRow& row);

/// Returns the limit pressure (Pa) of least magnitude that a run met, if any. Precondition: result.has_result()
std::optional<double> limit_pressure_Pa(const io::ProgramJobResult& result);

}  // namespace menger::evolution
