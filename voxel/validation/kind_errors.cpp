#include "voxel/validation/kind_errors.h"

#include "meshes/design/polycube.h"
#include "voxel/validation/validation_summary.h"

namespace menger::voxel {
namespace {

BodyKind kind_of_case(const meshes::LoadCase& load_case) {
  const auto [nx, ny, nz] = load_case.cells;
  return kind_of(meshes::Polycube::from_digits(nx, ny, nz, load_case.digits), load_case.level);
}

/// The errors of bodies of one kind; nothing if none has a displacement inside the range of validity.
std::optional<KindErrors> errors_of(const std::vector<CurveComparison>& comparisons) {
  KindErrors errors;
  for (const std::string& body : bodies_of(comparisons)) {
    const std::vector<ErrorSummary> summaries = summarise(comparisons, body);
    if (find_summary(summaries, ObservableKind::displacement) == nullptr) continue;
    errors.bodies.push_back(body);
  }
  if (errors.bodies.empty()) return std::nullopt;
  const std::vector<ErrorSummary> summaries = summarise(comparisons);
  const ErrorSummary& displacement = *find_summary(summaries, ObservableKind::displacement);
  errors.displacements = displacement.count + displacement.without_equilibrium;
  errors.displacement_median = displacement.median;
  errors.displacement_ninth_decile = displacement.percentile_90;
  if (const ErrorSummary* volume = find_summary(summaries, ObservableKind::volume); volume != nullptr) {
    errors.volumes = volume->count + volume->without_equilibrium;
    errors.volume_median = volume->median;
  }
  for (const SignCount& signs : count_signs(comparisons)) {
    if (!signs.inside) continue;
    errors.signs += signs.count;
    errors.wrong_signs += signs.wrong;
  }
  return errors;
}

}  // namespace

ExpectedErrors expected_errors(const std::vector<CurveComparison>& comparisons, const SurrogateParameters& parameters) {
  ByBodyKind<std::vector<CurveComparison>> by_kind;
  for (const CurveComparison& comparison : comparisons)
    by_kind.at(static_cast<std::size_t>(kind_of_case(comparison.load_case()))).push_back(comparison);
  ExpectedErrors errors{.parameters_hash = hash_of(parameters)};
  for (std::size_t kind = 0; kind < by_kind.size(); ++kind) errors.kinds.at(kind) = errors_of(by_kind.at(kind));
  return errors;
}

}  // namespace menger::voxel
