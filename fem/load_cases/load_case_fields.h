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

/// Fields of the states of a load case beside its curve: `fields/CASE/fields.pvd`, which names one step per row of the curve, in
/// the order of its rows (see FieldSeries for what a step holds; its TimeValue is the place of the state, see CaseObserver).
///
/// They are collected in cache/KEY and take their place when all are there, together with a file `content_hash` that says of
/// which answer they are. Collective, but for what asks.
class LoadCaseFields {
 public:
  /// @param folder of the curves
  /// @param key hash of everything that decides the answer
  LoadCaseFields(const std::filesystem::path& folder, const std::string& name, std::string key, MPI_Comm communicator);

  /// Whether the fields of this answer are in their place.
  [[nodiscard]] bool are_kept() const;

  /// Removes fields in their place that are of another answer, and no other file. @throws io::InputError if one cannot be
  void remove_others() const;

  /// Collects the fields of a state. @throws io::InputError if they cannot be written
  void add(std::size_t place, Equilibrium& equilibrium, const PathPoint& point, const BodyState& state);

  /// Puts what was collected into its place, instead of what is there. @throws io::InputError if that cannot be done
  void publish();

  /// Forgets what was collected.
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
