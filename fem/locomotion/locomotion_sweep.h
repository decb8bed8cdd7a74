#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fem/locomotion/locomotion_result.h"
#include "fem/locomotion/locomotion_run.h"
#include "fem/locomotion/locomotion_study.h"
#include "io/text/csv_table.h"

namespace menger::fem {

/// One run of a sweep.
struct SweepCase {
  double value = 0.0;  ///< of the swept keys
  LocomotionResult result;
};

/// Returns the studies of a sweep: the study with each value in place of the numbers that the keys name.
/// @param study with a sweep
/// @throws io::InputError naming file, key and value for a key that is no number of the study, and for a value that the study
/// rejects
std::vector<LocomotionStudy> sweep_studies(const LocomotionStudy& study);

/// Runs all cases of a sweep, each into its own folder case_01, case_02, ... (see run_locomotion). Writes sweep.csv after each
/// case, sweep.png at the end, and manifest.json. A case that fails does not stop the others. After a stop, the same call resumes
/// the sweep.
/// @param ran called after each case with its number, from 1
/// @return the cases that were run
/// @throws io::InputError if the folder holds results of another program, or a case cannot begin; no case has run then
std::vector<SweepCase> run_sweep(const LocomotionStudy& study, const std::filesystem::path& folder,
                                 const LocomotionRunOptions& options = {},
                                 const std::function<void(std::size_t number, const SweepCase& done)>& ran = {});

/// Returns a table with one line per case: its number, the values of the keys, status, travel (empty if the case did not
/// complete), seconds.
io::CsvTable sweep_table(const LocomotionSweep& sweep, const std::vector<SweepCase>& cases);

}  // namespace menger::fem
