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

/// What is compared, by its meaning.
enum class ObservableKind {
  displacement,     ///< extents, top, tip
  volume,           ///< change of chamber volume
  force,            ///< force or moment of a plate
  stiffness,        ///< slope of force or moment over what is imposed, at one pressure
  frequency,        ///< the first natural one
  higher_frequency  ///< the second and third: modes that lie close together may change places
};
inline constexpr std::size_t observable_kind_count = 6;
std::string_view to_string(ObservableKind kind);

/// The error of one number.
struct ObservableError {
  ObservableKind kind = ObservableKind::displacement;
  std::string observable;  ///< column of the curve; "stiffness" with its unit for slopes
  double pressure_Pa = 0.0;
  std::optional<double> imposed{};
  double reference = 0.0;
  double surrogate = 0.0;
  double error = 0.0;                     ///< (surrogate - reference) by the scale of the observable, see compare
  std::optional<double> pointwise_error;  ///< by the reference itself; none where that is below a thousandth of the scale
  Validity validity = Validity::inside;
};

/// A number that the surrogate has no answer to.
struct UnansweredNumber {
  ObservableKind kind = ObservableKind::displacement;
  Validity validity = Validity::inside;  ///< by all that is known without an answer, which leaves out strains

  bool operator==(const UnansweredNumber&) const = default;
};

/// A response curve and what the surrogate makes of it.
struct CurveComparison {
  meshes::ResponseCurve curve;
  std::string body;                                       ///< see body_names
  LoadCaseResponse answer;                                ///< at the states of the curve, as far as it goes
  std::vector<std::optional<std::size_t>> answer_rows{};  ///< by row of the curve that of the answer, if there is one
  std::vector<Validity> validity{};                       ///< by row of the curve
  std::vector<ObservableError> errors;                    ///< by observable, then row; slopes last
  std::vector<UnansweredNumber> unanswered;               ///< in the same order

  [[nodiscard]] const meshes::LoadCase& load_case() const { return curve.provenance.load_case; }
};

/// Names for the bodies of curves: the name of the case without the word for its kind ("menger_inflation": "menger"). Curves of
/// equal bodies (cells, digits, level, chambers) bear the name of the first of them, different bodies different names.
std::vector<std::string> body_names(const std::vector<meshes::ResponseCurve>& curves);

/// Rows of abscissae of a curve.
std::vector<std::vector<double>> states_of(const meshes::ResponseCurve& curve);

/// Compares the surrogate with a curve, state by state. Where it does not come to the end of the curve, vacuum and pressure are
/// asked for apart, each from rest on, so that an end under vacuum leaves the answers under pressure and those of milder vacuum.
///
/// The error of an observable is its difference by its largest magnitude in the curve, or by a hundredth of the largest of its
/// kind there if that is more: a top that does not move is not to be met to five per cent of nothing. States in which nothing is
/// done to the body (all abscissae zero) say nothing, but for their frequencies, and are left out; so are observables that are
/// zero throughout together with all of their kind. The stiffness at a pressure is the slope of the straight line of least
/// squares through force over imposed value; it needs two values.
/// @param validity what is claimed of each row of the curve, for judging several parameters by the same numbers; worked out from
/// the parameters if not given
CurveComparison compare(const meshes::ResponseCurve& curve, const std::string& body, const SurrogateParameters& parameters,
                        const Responder& responder, const std::optional<std::vector<Validity>>& validity = std::nullopt);

}  // namespace menger::voxel
