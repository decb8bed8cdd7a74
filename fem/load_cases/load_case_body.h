#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "fem/inflation/observables.h"
#include "fem/load_cases/load_case_study.h"
#include "fem/statics/body_ends.h"
#include "fem/statics/equilibrium.h"
#include "fem/statics/inflation_path.h"

namespace menger::fem {

/// The hollow body of a load case in the grips of its kind, with its solver and its measures. All chambers form one plenum.
class LoadCaseBody {
 public:
  /// Meshes the body of a case and makes its solver.
  /// @throws io::InputError naming the case and what cannot be meshed
  LoadCaseBody(const meshes::LoadCase& load_case, const StudyMaterial& material, const LoadCaseElements& elements,
               MPI_Comm communicator);
  LoadCaseBody(const LoadCaseBody&) = delete;
  LoadCaseBody& operator=(const LoadCaseBody&) = delete;

  [[nodiscard]] Equilibrium& equilibrium() { return *equilibrium_; }
  [[nodiscard]] std::size_t unknowns() const { return 3 * static_cast<std::size_t>(space_.node_count); }
  [[nodiscard]] std::size_t element_count() const { return space_.element_count; }

  /// Returns the drives at rest: no plate moves, the pressure is 0, and there is no gravity.
  [[nodiscard]] PathDrives at_rest() const;

  /// Returns the drives that take the imposed value of the load case from 0 at the first knot to `value` at the second.
  [[nodiscard]] PathDrives impose(double value) const;

  /// Returns the ordinates of response_columns at a state; empty for modes, which are computed elsewhere.
  [[nodiscard]] std::vector<double> ordinates(const PathPoint& point, const BodyState& state) const;

 private:
  void add_grips(const meshes::HexahedralMesh& mesh);
  void add_soles();
  [[nodiscard]] Point top_displacement_m(const BodyState& state) const;
  /// Returns how much the height of the top (the mean of its points) over the mean of the bottom faces has grown, after the
  /// rotation of the body is removed.
  [[nodiscard]] double top_rise_m(const BodyState& state) const;

  meshes::LoadCase load_case_;
  Point low_{};
  Point high_{};
  Body body_;
  Space space_;
  std::unique_ptr<Equilibrium> equilibrium_;
  std::unique_ptr<BodyEnds> ends_;
  std::vector<LocatedPoint> top_;  ///< see meshes::top_of
  std::vector<FaceMean> soles_;    ///< of the feet, where response_columns asks for them
  double rest_volume_m3_ = 0.0;
};

/// Checks that the body of a case can be meshed and fits into the memory of this machine (see estimated_memory_bytes).
/// @throws io::InputError naming the case and what cannot be meshed, or the keys that decide its size
void require_meshable(const meshes::LoadCase& load_case, const LoadCaseElements& elements);

}  // namespace menger::fem
