#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fem/load_cases/load_case_run.h"
#include "meshes/load_cases/response_curve.h"

namespace menger::fem {

/// How one case of a set ended.
struct CaseOutcome {
  std::string name{};
  meshes::LoadCaseKind kind = meshes::LoadCaseKind::inflation;
  io::RunStatus status = io::RunStatus::completed;
  std::string reason{};
  std::size_t states = 0;   ///< rows of the curve that was written; 0: none was
  bool from_cache = false;  ///< nothing of it had to be computed
  double seconds = 0.0;     ///< processor time of this run
};

/// How a set is run, never what comes out of it.
struct SetOptions {
  const std::atomic<bool>* stop = nullptr;
  bool pictures = true;
  bool fields = false;  ///< keep the fields of every state, see LoadCaseFields
  /// Called while a case is computed: its place in the set, the part of it that is done, and what was reached.
  std::function<void(std::size_t index, double part, const std::string& note)> progress{};
  std::function<void(const CaseOutcome& outcome)> finished{};  ///< called after every case
  MPI_Comm communicator = MPI_COMM_WORLD;
};

/// Computes the cases of a set in their order and writes NAME.csv, NAME.toml (see write_response_curve) and NAME.png of each into
/// `folder`, and manifest.json.
///
/// Answers are kept in folder/cache under a hash of everything that decides them: load case, law, elements, version of menger,
/// but neither the name of the case nor the rest of the set. A case that is found there is not computed again. Where a case asks
/// for fractions of contact or limit pressure, the inflation that finds them is kept there, too; where that ended early the case
/// has its status and says so, since its pressures are not those that were meant. Cases that the user stops
/// are not kept; of a case that ended early the states that it reached are written with its status. Of a case that reached none,
/// what an earlier run left under its name is removed, and the reason says so.
///
/// With `fields` the fields of every row of NAME.csv are written into fields/NAME; a cached case that has none is computed again
/// for them. Without, those that are there stay as long as they belong to the curve, and are removed when it changes.
/// @throws io::InputError naming the case or the file; what cannot be meshed is found before anything is computed
std::vector<CaseOutcome> run_load_case_set(const LoadCaseStudy& study, const std::filesystem::path& folder,
                                           const SetOptions& options = {});

}  // namespace menger::fem
