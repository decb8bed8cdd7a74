#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/text/csv_table.h"
#include "voxel/calibration/calibration_fit.h"

namespace menger::voxel {

struct IdentifiabilityOptions {
  int fit_count = 40;
  std::uint64_t seed = 1;     ///< of the first fit; the next have the next ones
  double start_factor = 3.0;  ///< each fit starts this far from the truth, up or down by chance; softening starts at zero
  const std::atomic<bool>* stop = nullptr;
  std::function<void(int done)> progress{};  ///< may be empty
};

/// How often the 95 % interval of a parameter held the truth.
struct Coverage {
  std::string name;
  double truth = 0.0;
  double mean = 0.0;       ///< of the fitted values
  int interval_count = 0;  ///< fits that gave an interval
  int hit_count = 0;       ///< of which this many held the truth
};

struct Identifiability {
  std::vector<Coverage> coverage;  ///< by parameter
  int fit_count = 0;               ///< that were made
  int failed_count = 0;            ///< did not converge, and are counted nowhere else
};

/// Fits curves made from known parameters, with Gaussian noise of the curves' own standard deviations.
/// @param curves whose references are replaced @param parameters that are fitted; the others are known
Identifiability identifiability(const std::vector<FittedCurve>& curves, const std::vector<FittedParameter>& parameters,
                                const SurrogateParameters& truth, const Responder& responder,
                                const IdentifiabilityOptions& options);

/// The parameters of a fit that it claims to know, those with an interval.
std::vector<FittedParameter> claimed_parameters(const CalibrationFit& fit);

/// Numbers of hits of n that chance leaves 99 % of the time, tails of at most half a per cent cut off at both ends, if each hits
/// with `probability`.
std::pair<int, int> likely_hits(int n, double probability);

/// Columns parameter, truth, mean, intervals, hits, lowest_likely_hits, highest_likely_hits.
io::CsvTable identifiability_table(const Identifiability& result);

}  // namespace menger::voxel
