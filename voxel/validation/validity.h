#pragma once

#include <string_view>
#include <vector>

#include "voxel/statics/load_case_response.h"

namespace menger::voxel {

/// Whether parameters claim anything about a state; otherwise the first of the reasons why not, in this order.
enum class Validity {
  inside,
  chambers,  ///< the body's layout of chambers is not that of the fit
  size,      ///< the body is longer than those of the fit, in cells of a module or in modules
  pressure,  ///< beyond what was fitted for the walls of the body, see covered_pressures.h
  strain     ///< of a beam
};
std::string_view to_string(Validity validity);

/// What parameters claim about the states of a load case.
///
/// The answer knows the strains of all states together; where these leave the range, each state is asked for alone. Lengths and
/// pressures at the end of a range are inside but for rounding.
/// @param states rows of abscissae @param answer to all of them
std::vector<Validity> validities(const std::vector<std::vector<double>>& states, const meshes::LoadCase& load_case,
                                 const LoadCaseResponse& answer, const SurrogateParameters& parameters,
                                 const Responder& responder);

}  // namespace menger::voxel
