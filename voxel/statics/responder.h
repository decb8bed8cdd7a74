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

/// The response of a surrogate to a load case.
struct LoadCaseResponse {
  /// completed, or why not:
  /// - not_converged: no equilibrium was found for a state.
  /// - limit_point: the laws of the body's walls give no usable size at the pressure of a state (driven_sizes), or its
  /// equilibrium is not stable and so has no modes.
  /// - wall_contact: facing chamber walls touch (BodyShape::wall_contact). Beyond this, beams would pass through each other.
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};                     ///< why, if there is more to say than the status
  std::vector<std::string> columns;         ///< meshes::response_columns of the load case
  std::vector<std::vector<double>> values;  ///< by column; rows as in the load case, only those reached
  double smallest_strain = 0.0;             ///< axial, of any beam in any state: length / rest length - 1
  double largest_strain = 0.0;
};

/// Parameters on both sides of given ones, with their distances in the coordinate of the derivative.
struct ParameterSpan {
  SurrogateParameters below;
  SurrogateParameters above;
  double below_by = 0.0;  ///< >= 0; 0: there are none below, and `below` is not used
  double above_by = 0.0;  ///< >= 0; 0: there are none above, and `above` is not used
};

/// Derivatives by column, then row, as the values of a response; those of abscissae are zero.
using ResponseSlope = std::vector<std::vector<double>>;

/// The response of a surrogate to a load case, and its derivatives with respect to parameters.
struct ResponseSlopes {
  LoadCaseResponse response;
  std::vector<std::optional<ResponseSlope>> slopes;  ///< by span; nothing if neither side has a response
};

/// Computes responses to a load case at given states. States are rows of abscissae; without any, those of the load case are used.
/// Responses come from equilibria of the surrogate, or from a closed form in their place.
class Responder {
 public:
  using States = std::vector<std::vector<double>>;
  using Response = std::function<LoadCaseResponse(const SurrogateParameters&, const meshes::LoadCase&, const States&)>;
  using Slopes = std::function<ResponseSlopes(const SurrogateParameters&, const meshes::LoadCase&, const States&,
                                              const std::vector<ParameterSpan>&)>;

  Responder() = default;

  /// A responder without derivatives of its own.
  template <class Function>
  requires(!std::same_as<Function, Responder> && std::constructible_from<Response, Function>) Responder(Function response)
      : response_(std::move(response)) {}

  Responder(Response response, Slopes slopes) : response_(std::move(response)), slopes_(std::move(slopes)) {}

  LoadCaseResponse operator()(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                              const States& states) const {
    return response_(parameters, load_case, states);
  }

  /// The response of the surrogate with some parameters, and its derivatives. A responder without derivatives of its own takes
  /// differences of responses: central ones, or one-sided ones if a side is not given or has no response.
  [[nodiscard]] ResponseSlopes slopes(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                                      const States& states, const std::vector<ParameterSpan>& spans) const;

 private:
  Response response_;
  Slopes slopes_;
};

}  // namespace menger::voxel
