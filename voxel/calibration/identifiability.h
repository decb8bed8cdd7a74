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
  std::uint64_t seed = 1;     ///< of the first fit; each further fit has the next seed
  double start_factor = 3.0;  ///< each value starts this factor above or below the truth, at random; softening starts at zero
  const std::atomic<bool>* stop = nullptr;
  std::function<void(int done)> progress{};  ///< may be empty
};

/// How often the 95 % interval of a parameter contained the true value.
struct Coverage {
  std::string name;
  double truth = 0.0;
  double mean = 0.0;       ///< of the fitted values
  int interval_count = 0;  ///< number of fits that gave an interval
  int hit_count = 0;       ///< number of these intervals that contained the truth
};

struct Identifiability {
  std::vector<Coverage> coverage;  ///< by parameter
  int fit_count = 0;               ///< number of fits made
  int failed_count = 0;            ///< fits that did not converge; they are counted nowhere else
};

/// Tests whether fits find known parameters again. It fits curves that are computed from them, with Gaussian noise of the curves'
/// own standard deviations.
/// @param curves their references are replaced @param parameters to fit; the others are known
Identifiability identifiability(const std::vector<FittedCurve>& curves, const std::vector<FittedParameter>& parameters,
                                const SurrogateParameters& truth, const Responder& responder,
                                const IdentifiabilityOptions& options);

/// The parameters of a fit that have an interval.
std::vector<FittedParameter> claimed_parameters(const CalibrationFit& fit);

/// The range of numbers of hits, of n, that occur by chance 99 % of the time if each hits with `probability`. A tail of at most
/// half a per cent is cut off at both ends.
std::pair<int, int> likely_hits(int n, double probability);

/// The result as a table: parameter, truth, mean, intervals, hits, lowest_likely_hits, highest_likely_hits.
io::CsvTable identifiability_table(const Identifiability& result);

}  // namespace menger::voxel
