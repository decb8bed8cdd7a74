#pragma once

#include <mpi.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/load_cases/load_case_study.h"
#include "fem/statics/equilibrium.h"
#include "fem/statics/inflation_path.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// Called with every state that gives a row. States come in the order in which the paths reach them.
/// @param place index of the state among all that were asked for, by ascending abscissae; it is the state's row if all were
/// reached
using CaseObserver =
    std::function<void(std::size_t place, Equilibrium& equilibrium, const PathPoint& point, const BodyState& state)>;

/// Options of a case that do not change its results.
struct CaseOptions {
  const std::atomic<bool>* stop = nullptr;  ///< ends the case with status `stopped`
  /// Called with the fraction of the case that is done, 0 to 1, and a note on what was reached.
  std::function<void(double part, const std::string& note)> progress{};
  CaseObserver observer{};
  MPI_Comm communicator = MPI_COMM_WORLD;
};

/// The response of a body to a load case.
struct CaseResponse {
  io::RunStatus status = io::RunStatus::completed;  ///< of the first path that ended early
  std::string reason;                               ///< where and why it ended, for users
  std::vector<double> pressures_Pa;                 ///< the requested pressures, ascending
  std::vector<std::vector<double>> rows;            ///< rows of response_columns that were reached, ascending by their abscissae
  std::optional<double> limit_pressure_Pa;          ///< for inflations that search for it
  std::optional<double> contact_pressure_Pa;
  std::size_t elements = 0;
  std::size_t unknowns = 0;
  LinearMethod linear = LinearMethod::direct;  ///< the method for linear systems
};

/// Computes a load case with finite elements.
///
/// The body is first brought to every pressure without an imposed value, from rest upwards and from rest downwards. From each of
/// these states the imposed value is increased from 0, and then, again from that state, decreased. A path that ends early (walls
/// touch, no stable equilibrium, Newton's method fails) leaves out its further states; the others continue.
///
/// An inflation without pressures first searches for its range (see find_pressure_range). A third of its states lie between 0.98
/// of the vacuum found there and zero, the others between zero and safe_share of the limit pressure. If there is no limit point
/// before the elements fail, the largest pressure that was reached is the upper end, and the reason says so.
/// @param request with pressures, or an inflation that finds them (asserts)
/// @throws io::InputError naming the case and what cannot be meshed
CaseResponse run_load_case(const CaseRequest& request, const StudyMaterial& material, const CaseOptions& options = {});

}  // namespace menger::fem
