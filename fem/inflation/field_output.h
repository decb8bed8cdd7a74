#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fem/space/space.h"
#include "fem/statics/nodal_fields.h"
#include "io/vtk/collection.h"

namespace menger::fem {

/// Names of what a file of fields numbers; those that are not known are left out of it.
struct FieldNames {
  std::vector<std::string> plena{};    ///< of FieldStep::plenum_pressures_Pa
  std::vector<std::string> regions{};  ///< of the cell data `region`
};

/// The values in a file of fields that belong to the state as a whole.
struct FieldStep {
  int step = 0;                               ///< number of the state on its path, and in the file's name
  double s = 0.0;                             ///< path parameter, written as TimeValue
  std::vector<double> plenum_pressures_Pa{};  ///< gauge
  FieldNames names{};
};

/// Writes the fields of the states of a path for ParaView: `fields/step_0000.vtu`, ... and the collection `fields.pvd` in a
/// folder. With several ranks each one writes a piece, `fields/step_0000_<rank>.vtu`, and the first rank writes
/// `fields/step_0000.pvtu`, which names the pieces.
///
/// Files follow the convention of io/vtk/README.md: the points are those of the deformed body. Cells are hexahedra with all nodes
/// of their elements (VTK_HEXAHEDRON or VTK_TRIQUADRATIC_HEXAHEDRON). Point data: displacement_m; means over the elements of a
/// node (see NodalFields): cauchy_stress_Pa (xx, yy, zz, xy, yz, xz), pressure_Pa (-tr/3 of that stress), principal_stretches
/// (the largest first). Cell data: those of ElementState, in single precision, with largest_stretch as active scalars; region
/// (index), rank. Field data: TimeValue (path parameter), plenum_pressures_Pa, plenum_names, region_names. Compressed.
///
/// All members are collective. Every file is written whole or not at all.
/// @throws io::InputError on all ranks if a file cannot be written
class FieldSeries {
 public:
  FieldSeries(std::filesystem::path folder, MPI_Comm communicator);

  /// Keeps the files of the given steps, which become the members of the collection, and removes all other files of fields, and
  /// nothing else. Without any steps the collection is removed, too.
  void keep_only(const std::vector<FieldStep>& steps);

  /// Writes the fields of a state, and the collection with them.
  void add(const Space& space, std::span<const double> displacements, const NodalFields& fields, const FieldStep& step);

 private:
  /// The file of a step in the collection, and a rank's piece of it.
  [[nodiscard]] std::filesystem::path step_file(int step) const;
  [[nodiscard]] std::filesystem::path piece_file(int step, int rank) const;
  [[nodiscard]] io::CollectionEntry entry_of(const FieldStep& step) const;
  void write_collection() const;

  std::filesystem::path folder_;
  MPI_Comm communicator_;
  int rank_ = 0;
  int rank_count_ = 1;
  std::vector<io::CollectionEntry> entries_;  ///< complete on the first rank, which writes the collection
};

}  // namespace menger::fem
