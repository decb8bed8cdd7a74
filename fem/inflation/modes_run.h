#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/inflation/inflation_study.h"
#include "fem/modes/frequency_response.h"
#include "fem/modes/vibration.h"

namespace menger::fem {

/// Options of run_modes, which computes small vibrations of a study's body about the states of its path.
struct ModesOptions {
  int mode_count = 6;  ///< > 0
  /// Gauge pressure of all plena at which the body vibrates, instead of the study's path.
  std::optional<double> pressure_Pa{};
  double loss_factor = 0.0;                 ///< >= 0, of structural damping in the frequency response
  const std::atomic<bool>* stop = nullptr;  ///< ends the run with status `stopped`; the frequencies found so far are written
  /// Called after every part of the work, with the fraction done, 0 to 1, and a note on the current work.
  std::function<void(double part, const std::string& note)> progress{};
};

/// The vibrations about one state of the path.
struct ModesState {
  double s = 0.0;
  std::vector<double> pressures_Pa{};  ///< gauge, per plenum
  VibrationReport vibrations{};
};

/// The response of an observable to 1 Pa in all plena, in phase, about the last state.
struct ModesCurve {
  std::string name{};
  std::string unit{};  ///< m or m3
  std::vector<std::optional<std::complex<double>>> amplitudes{};
};

/// The result of a run of `menger modes`.
struct ModesResult {
  /// Of the path; if that completed, of the first state whose modes were not found.
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};
  std::vector<std::string> plenum_names{};
  std::vector<ModesState> states{};      ///< at the knots and stations of the path
  std::vector<double> frequencies_Hz{};  ///< of the response: 0.5 to 5 Hz, and on to 1.5 times the first natural frequency
  std::vector<ModesCurve> curves{};      ///< empty if the last state has no modes
  std::vector<std::string> notes{};
  std::string linear_solver{};  ///< the method for linear systems of the path, and why: "direct: ..."
  std::size_t elements = 0;
  std::size_t unknowns = 0;
  double seconds = 0.0;
};

/// Inflates a study's body and computes its natural frequencies at the knots and stations of its path. About the last of these
/// states it computes the response to harmonic chamber pressure.
///
/// The body vibrates on the supports of the study, except for the two nodes that keep a guided or resting body from drifting. Its
/// horizontal rigid motions are therefore free, and are not among the modes.
///
/// Writes into `folder`, each file whole or not at all: modes.csv, frequency_response.csv and .png, modes/mode_01.vtu, ...
/// (shapes about the last state), result.toml, manifest.json. Files of these names that an earlier run left are removed. One
/// process.
/// @throws io::InputError naming file and key if a material has no density, which otherwise only gravity needs; as make_problem
/// does; if the folder cannot be written
ModesResult run_modes(const InflationStudy& study, const std::filesystem::path& folder, const ModesOptions& options = {});

}  // namespace menger::fem
