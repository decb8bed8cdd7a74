#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/text/run_status.h"
#include "meshes/load_cases/load_case.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// A surrogate's answer to a load case.
struct LoadCaseResponse {
  /// not_converged where a state has no equilibrium that was found; limit_point where its pressure lies beyond what a law of the
  /// body's walls knows, or where it is not stable and so has no modes; wall_contact where chamber walls that face each other
  /// have met (BodyShape::wall_contact), beyond which beams would go on as if they passed through each other
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};                     ///< why, where there is more to say than the status
  std::vector<std::string> columns;         ///< meshes::response_columns(kind)
  std::vector<std::vector<double>> values;  ///< by column; rows as in the load case; only the rows reached
  double smallest_strain = 0.0;             ///< of any beam in any state, axial, beyond the rest length
  double largest_strain = 0.0;
};

/// Parameters on both sides of others, and how far away they are in the coordinate whose derivatives are sought.
struct ParameterSpan {
  SurrogateParameters below;
  SurrogateParameters above;
  double below_by = 0.0;  ///< >= 0; 0: nothing is known below, and `below` is not looked at
  double above_by = 0.0;  ///< likewise
};

/// By column, then row, as the values of a response; abscissae do not change.
using ResponseSlope = std::vector<std::vector<double>>;

/// A surrogate's answer to a load case and how it changes with its parameters.
struct ResponseSlopes {
  LoadCaseResponse response;
  std::vector<std::optional<ResponseSlope>> slopes;  ///< by span; nothing where there is no answer on either side
};

/// What answers to a load case at states (rows of abscissae; none: those of the load case): equilibria of the surrogate, or a
/// closed form in their place.
class Responder {
 public:
  using States = std::vector<std::vector<double>>;
  using Answer = std::function<LoadCaseResponse(const SurrogateParameters&, const meshes::LoadCase&, const States&)>;
  using Slopes = std::function<ResponseSlopes(const SurrogateParameters&, const meshes::LoadCase&, const States&,
                                              const std::vector<ParameterSpan>&)>;

  Responder() = default;

  /// From answers alone.
  template <class Function>
  requires(!std::same_as<Function, Responder> && std::constructible_from<Answer, Function>) Responder(Function answer)
      : answer_(std::move(answer)) {}

  Responder(Answer answer, Slopes slopes) : answer_(std::move(answer)), slopes_(std::move(slopes)) {}

  LoadCaseResponse operator()(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                              const States& states) const {
    return answer_(parameters, load_case, states);
  }

  /// The answer of parameters, and its derivatives. From answers alone they are differences: central ones, one-sided where one
  /// side is not known or has no answer.
  [[nodiscard]] ResponseSlopes slopes(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                                      const States& states, const std::vector<ParameterSpan>& spans) const;

 private:
  Answer answer_;
  Slopes slopes_;
};

}  // namespace menger::voxel
