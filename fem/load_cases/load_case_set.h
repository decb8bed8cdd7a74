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
  std::size_t states = 0;   ///< rows of the curve that was written; 0: no curve was written
  bool from_cache = false;  ///< whether nothing had to be computed
  double seconds = 0.0;     ///< processor time of this run
  std::string
      missing_picture{};  ///< why its picture could not be drawn, on the first rank; empty if it was, or none was asked for
};

/// Options of a set that do not change its results.
struct SetOptions {
  const std::atomic<bool>* stop = nullptr;
  bool pictures = true;
  bool fields = false;  ///< keep the fields of every state, see LoadCaseFields
  /// Called while a case is computed, with its index in the set, the fraction of it that is done, and a note on what was reached.
  std::function<void(std::size_t index, double part, const std::string& note)> progress{};
  std::function<void(const CaseOutcome& outcome)> finished{};  ///< called after every case
  MPI_Comm communicator = MPI_COMM_WORLD;
};

/// Computes the cases of a set in their order. Writes NAME.csv, NAME.toml (see write_response_curve) and NAME.png of each into
/// `folder`, and manifest.json.
///
/// Responses are cached in folder/cache under a hash of everything that they depend on: load case, law, elements, version of
/// menger. The name of the case and the rest of the set are not part of it. A case in the cache is not computed again.
///
/// If a case asks for fractions of contact or limit pressure, the inflation that finds these pressures is cached, too. If that
/// inflation ended early, the case gets its status and reason, because its pressures are not the intended ones.
///
/// Cases that the user stops are not cached. Of a case that ended early, the states that it reached are written with its status.
/// If it reached none, the files of an earlier run under its name are removed, and the reason says so.
///
/// With `fields`, the fields of every row of NAME.csv are written into fields/NAME. A cached case without fields is computed
/// again for them. Without `fields`, existing fields are kept as long as they belong to the curve, and are removed when it
/// changes.
/// @throws io::InputError naming the case or the file; bodies that cannot be meshed are found before anything is computed
std::vector<CaseOutcome> run_load_case_set(const LoadCaseStudy& study, const std::filesystem::path& folder,
                                           const SetOptions& options = {});

}  // namespace menger::fem
