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
  double value = 0.0;  ///< of the keys of the sweep
  LocomotionResult result;
};

/// The studies of a sweep: the study with each set of values in place of the numbers that it states.
/// @param study with a sweep @throws io::InputError naming file, key and value for a key that is no number of the study and a
/// value that the study refuses
std::vector<LocomotionStudy> sweep_studies(const LocomotionStudy& study);

/// Runs them all, each into a folder case_01, case_02, ... of its own (see run_locomotion), and writes sweep.csv after each and
/// sweep.png at the end. A case that fails does not stop the others; when stopped, the same call goes on.
/// @param ran is called after each case with its number, from 1
/// @return the cases that were run
std::vector<SweepCase> run_sweep(const LocomotionStudy& study, const std::filesystem::path& folder,
                                 const LocomotionRunOptions& options = {},
                                 const std::function<void(std::size_t number, const SweepCase& done)>& ran = {});

/// One line per case: its number, the values of the keys, status, travel (empty where it did not complete), seconds.
io::CsvTable sweep_table(const LocomotionSweep& sweep, const std::vector<SweepCase>& cases);

}  // namespace menger::fem
