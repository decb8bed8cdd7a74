#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "io/run_status.h"
#include "materials/load_case.h"
#include "voxel/surrogate_parameters.h"

namespace menger::voxel {

/// A surrogate's answer to a load case.
struct LoadCaseResponse {
  /// not_converged where a state has no equilibrium that was found; limit_point where its pressure lies beyond what a law of the
  /// body's walls knows, or where it is not stable and so has no modes; wall_contact where chamber walls that face each other
  /// have met (BodyShape::wall_contact), beyond which beams would go on as if they passed through each other
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};                     ///< why, where there is more to say than the status
  std::vector<std::string> columns;         ///< materials::response_columns(kind)
  std::vector<std::vector<double>> values;  ///< by column; rows as in the load case; only the rows reached
  double smallest_strain = 0.0;             ///< of any beam in any state, axial, beyond the rest length
  double largest_strain = 0.0;
};

/// What the surrogate of a body answers to a load case, at the states (pressure, imposed) that are asked for: equilibria of the
/// same beams that Simulation steps, found by Newton's method (see equilibrium.h), and small vibrations about them.
///
/// Plates are joined to the voxels at the end of the body by half beams of length L / 2 of those voxels' own class.
/// @param states rows of abscissae, as many as materials::abscissa_count(kind) each; empty: those of the load case
/// @throws std::invalid_argument if cell edge or wall thickness are not those of the parameters
LoadCaseResponse respond(const SurrogateParameters& parameters, const materials::LoadCase& load_case,
                         const std::vector<std::vector<double>>& states = {});

class Equilibrium;

/// Called with every state reached and its row.
using StateVisitor = std::function<void(std::size_t row, const Equilibrium& equilibrium)>;

/// The same, and shows its equilibria on the way.
LoadCaseResponse visit_states(const SurrogateParameters& parameters, const materials::LoadCase& load_case,
                              const std::vector<std::vector<double>>& states, const StateVisitor& visit);

/// What answers to a load case at states (rows of abscissae): respond, or a closed form in its place.
using Responder = std::function<LoadCaseResponse(const SurrogateParameters&, const materials::LoadCase&,
                                                 const std::vector<std::vector<double>>& states)>;

}  // namespace menger::voxel
