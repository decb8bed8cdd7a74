#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/run_status.h"
#include "meshes/load_cases/response_curve.h"
#include "voxel/statics/load_case_response.h"
#include "voxel/validation/validity.h"

namespace menger::voxel {

/// The kind of a compared quantity.
enum class ObservableKind {
  displacement,     ///< extents, heights of top and tip
  volume,           ///< change of chamber volume
  force,            ///< force or moment of a plate
  stiffness,        ///< slope of force or moment over the imposed value, at one pressure
  frequency,        ///< first natural frequency
  higher_frequency  ///< second and third natural frequency: modes that lie close together may change places
};
inline constexpr std::size_t observable_kind_count = 6;

/// Returns whether the errors of a kind decide how good the surrogate is: those of displacement and volume do.
constexpr bool is_aimed_at(ObservableKind kind) { return kind == ObservableKind::displacement || kind == ObservableKind::volume; }

std::string_view to_string(ObservableKind kind);

/// The error of one compared number.
struct ObservableError {
  ObservableKind kind = ObservableKind::displacement;
  std::string observable;  ///< column of the curve; "stiffness" with its unit for slopes
  double pressure_Pa = 0.0;
  std::optional<double> imposed{};
  double reference = 0.0;
  double surrogate = 0.0;
  double error = 0.0;  ///< (surrogate - reference) / scale of the observable, see compare
  /// (surrogate - reference) / |reference|; nothing if the reference is below a thousandth of the scale.
  std::optional<double> pointwise_error;
  Validity validity = Validity::inside;
};

/// A number for which the surrogate has no response.
struct UndeterminedNumber {
  ObservableKind kind = ObservableKind::displacement;
  /// Determined by all that is known without a response, that is, without strains.
  Validity validity = Validity::inside;

  bool operator==(const UndeterminedNumber&) const = default;
};

/// A response curve and the response of the surrogate to the same load case.
struct CurveComparison {
  meshes::ResponseCurve curve;
  std::string body;                                         ///< see body_names
  LoadCaseResponse response;                                ///< at the states of the curve, as far as it exists
  std::vector<std::optional<std::size_t>> response_rows{};  ///< by row of the curve: row in `response`, if there is one
  std::vector<Validity> validity{};                         ///< by row of the curve
  std::vector<ObservableError> errors;                      ///< by observable, then row; slopes last
  std::vector<UndeterminedNumber> without_equilibrium;      ///< in the same order

  [[nodiscard]] const meshes::LoadCase& load_case() const { return curve.provenance.load_case; }
};

/// Names for the bodies of curves: the name of the case without the word for its kind ("menger_inflation": "menger"). Curves of
/// equal bodies (cells, digits, level, chambers) share a name: if theirs differ, the common beginning ("table" of "table_low" and
/// "table_high"), or all of them ("table+desk"). Different bodies get different names.
std::vector<std::string> body_names(const std::vector<meshes::ResponseCurve>& curves);

/// The states of a curve: rows of abscissae.
std::vector<std::vector<double>> states_of(const meshes::ResponseCurve& curve);

/// Compares the surrogate with a curve, state by state. If its response ends before the curve, vacuum and pressure are computed
/// separately, each starting from rest. An end under vacuum then does not remove the responses under pressure and under milder
/// vacuum.
///
/// The error of an observable is its difference divided by its largest magnitude in the curve, or by a hundredth of the largest
/// magnitude of its kind if that is more. (A top that does not move cannot be met to a few per cent of zero.) States without any
/// load (all abscissae zero) have no information except frequencies, and are left out. Observables are left out if they and all
/// others of their kind are zero throughout. The stiffness at a pressure is the slope of the least-squares straight line through
/// force over imposed value; it needs two different values.
/// @param validity of each row of the curve, to evaluate several parameters by the same numbers; derived from the parameters if
/// not given
CurveComparison compare(const meshes::ResponseCurve& curve, const std::string& body, const SurrogateParameters& parameters,
                        const Responder& responder, const std::optional<std::vector<Validity>>& validity = std::nullopt);

}  // namespace menger::voxel
