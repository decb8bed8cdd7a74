#include "voxel/validation/validity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "voxel/model/covered_pressures.h"

namespace menger::voxel {

namespace {

using meshes::LoadCase;

bool within(double value, double lowest, double highest) {
  constexpr double rounding = 1e-9;
  const double slack = rounding * (1.0 + std::abs(lowest) + std::abs(highest));
  return value >= lowest - slack && value <= highest + slack;
}

bool strains_inside(const LoadCaseResponse& response, const ValidityRange& range) {
  return within(response.smallest_strain, range.smallest_strain, range.largest_strain) &&
         within(response.largest_strain, range.smallest_strain, range.largest_strain);
}

/// The reason why a body is outside the range of validity at any pressure, or inside.
Validity claimed(const SurrogateParameters& parameters, const LoadCase& load_case) {
  const bool per_phase = parameters.chambers == meshes::ChamberLayout::per_phase;
  if (load_case.per_phase != per_phase) return Validity::chambers;
  const int cells = meshes::longest_side_cells(load_case.cells, load_case.digits);
  const bool is_longer = cells > parameters.validity.longest_body_cells ||
                         meshes::longest_side_modules(cells, load_case.level) > parameters.validity.longest_aggregate_modules;
  return is_longer ? Validity::size : Validity::inside;
}

}  // namespace

std::string_view to_string(Validity validity) {
  constexpr std::array<std::string_view, 5> words{"inside", "chambers", "size", "pressure", "strain"};
  return words.at(static_cast<std::size_t>(validity));
}

std::vector<Validity> validities(const std::vector<std::vector<double>>& states, const LoadCase& load_case,
                                 const LoadCaseResponse& response, const SurrogateParameters& parameters,
                                 const Responder& responder) {
  const Validity of_body = claimed(parameters, load_case);
  const CoveredPressures covered = covered_pressures(parameters.validity, body_walls(load_case));
  const bool all_strains_inside = strains_inside(response, parameters.validity);
  std::vector<Validity> all;
  for (const std::vector<double>& state : states) {
    Validity validity = of_body;
    if (validity == Validity::inside && !covered.contains(state.front())) validity = Validity::pressure;
    if (validity == Validity::inside && !all_strains_inside) {
      const LoadCaseResponse alone = responder(parameters, load_case, {state});
      if (alone.status != io::RunStatus::completed || !strains_inside(alone, parameters.validity)) validity = Validity::strain;
    }
    all.push_back(validity);
  }
  return all;
}

}  // namespace menger::voxel
