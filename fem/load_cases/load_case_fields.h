#pragma once

#include <mpi.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "fem/inflation/field_output.h"
#include "fem/statics/equilibrium.h"
#include "fem/statics/inflation_path.h"

namespace menger::fem {

/// Writes the fields of the states of a load case beside its curve: `fields/CASE/fields.pvd`, which names one step per row of the
/// curve, in the order of its rows. See FieldSeries for the content of a step; its TimeValue is the index of the state, see
/// CaseObserver.
///
/// The fields are collected in cache/KEY and moved to their place when all are there. A file `content_hash` beside them names the
/// response to which they belong. Collective, except for are_kept.
class LoadCaseFields {
 public:
  /// Prepares the fields of a case.
  /// @param folder of the curves
  /// @param key hash of everything that the response depends on
  LoadCaseFields(const std::filesystem::path& folder, const std::string& name, std::string key, MPI_Comm communicator);

  /// Returns whether the fields of this response are in their place.
  [[nodiscard]] bool are_kept() const;

  /// Removes fields in their place that belong to another response, and no other file.
  /// @throws io::InputError if a file cannot be removed
  void remove_others() const;

  /// Writes the fields of a state into the collection.
  /// @throws io::InputError if they cannot be written
  void add(std::size_t place, Equilibrium& equilibrium, const PathPoint& point, const BodyState& state);

  /// Moves the collected fields to their place, where they replace earlier ones.
  /// @throws io::InputError if that fails
  void publish();

  /// Removes the collected fields.
  void discard() const;

 private:
  std::filesystem::path place_;
  std::filesystem::path collected_;
  std::string key_;
  MPI_Comm communicator_;
  FieldSeries series_;
  std::vector<FieldStep> steps_{};
};

}  // namespace menger::fem
