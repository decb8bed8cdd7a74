#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// The motion of a body at one time; component i of node a at 3 a + i.
struct MovedBody {
  double time_s = 0.0;
  std::span<const double> displacements_m;
  std::span<const double> velocities_m_per_s;
  std::span<const double> plenum_pressures_Pa;  ///< gauge, one per plenum
};

/// Returns the body at its current position: its elements as hexahedra and the walls of its chambers as quadrilaterals.
vtkSmartPointer<vtkUnstructuredGrid> moved_body_grid(const meshes::HexahedralMesh& mesh, const MovedBody& body);

/// Writes frames of a run for ParaView: frames/frame_0000.vtu, ... and the collection frames.pvd in a folder. Each file is
/// written whole or not at all.
/// @throws io::InputError if a file cannot be written
class LocomotionFrames {
 public:
  explicit LocomotionFrames(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Prepares the folder for a run that is resumed: keeps its first frames, removes all later ones, and lists those that are left
  /// for ParaView.
  /// @param times_s of the frames that stay
  void keep_only(const std::vector<double>& times_s);

  /// Adds the next frame.
  void add(const meshes::HexahedralMesh& mesh, const MovedBody& body);

 private:
  void write_collection() const;
  std::filesystem::path folder_;
  std::vector<double> times_s_;
};

}  // namespace menger::fem
