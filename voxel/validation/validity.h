#pragma once

#include <string_view>
#include <vector>

#include "voxel/statics/load_case_response.h"

namespace menger::voxel {

/// Whether a state lies inside the range of validity of parameters; otherwise the first reason why not, in this order.
enum class Validity {
  inside,
  chambers,  ///< the body has another layout of chambers than the fit
  size,      ///< the body is longer than those of the fit, in cells of a module or in modules
  pressure,  ///< beyond the pressures fitted for the walls of the body, see covered_pressures.h
  strain     ///< strain of a beam beyond those of the fit
};
std::string_view to_string(Validity validity);

/// The validity of each state of a load case.
///
/// The response has the strains of all states together. If they leave the range, the strains of each state are computed
/// separately. Lengths and pressures at the end of a range count as inside, with a tolerance for rounding.
/// @param states rows of abscissae @param response response to all of them
std::vector<Validity> validities(const std::vector<std::vector<double>>& states, const meshes::LoadCase& load_case,
                                 const LoadCaseResponse& response, const SurrogateParameters& parameters,
                                 const Responder& responder);

}  // namespace menger::voxel
