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

/// Called with every state that gives a row. @param place of the state among all that were asked for, by ascending abscissae,
/// which is its row if all were reached; states come in the order in which paths meet them
using CaseObserver =
    std::function<void(std::size_t place, Equilibrium& equilibrium, const PathPoint& point, const BodyState& state)>;

/// How a case is run, never what comes out of it.
struct CaseOptions {
  const std::atomic<bool>* stop = nullptr;  ///< ends the case with status `stopped`
  /// Called with the part of the case that is done, 0 to 1, and what was reached.
  std::function<void(double part, const std::string& note)> progress{};
  CaseObserver observer{};
  MPI_Comm communicator = MPI_COMM_WORLD;
};

/// What a body answered to a load case.
struct CaseAnswer {
  io::RunStatus status = io::RunStatus::completed;  ///< of the first path that ended early
  std::string reason;                               ///< where and why it did, for people
  std::vector<double> pressures_Pa;                 ///< that were asked for, ascending
  std::vector<std::vector<double>> rows;            ///< of response_columns, those reached, ascending by their abscissae
  std::optional<double> limit_pressure_Pa;          ///< of inflations that look for it
  std::optional<double> contact_pressure_Pa;
  std::size_t elements = 0;
  std::size_t unknowns = 0;
};

/// Computes a load case with finite elements.
///
/// The body is first brought to every pressure without anything imposed, from rest upwards and from rest downwards; from each of
/// these states the imposed value grows, and then falls. A path that ends early (walls touch, no stable equilibrium, Newton's
/// method fails) leaves out its further states; the others go on.
///
/// An inflation without pressures first finds its range (see find_pressure_range). Its states lie between 0.98 of that vacuum, a
/// third of them below zero, and safe_share of the limit. Where there is no limit point before the elements fail, the largest
/// pressure that was reached takes its place, and the reason says so.
/// @param request with pressures, or an inflation that finds them (asserts)
/// @throws io::InputError naming the case and what cannot be meshed
CaseAnswer run_load_case(const CaseRequest& request, const StudyMaterial& material, const CaseOptions& options = {});

}  // namespace menger::fem
